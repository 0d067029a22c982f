"""Covariances of `imu` and `odom`, given as diagonals, for filters that use these messages.

They change nothing in the data, which are exact without sensors; those of sensors come from their
noise. In sensor_msgs/Imu, all zeros mean "covariance unknown".
"""

import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.simulation.sensors import Sensors
from vehicle_roll_sim.vehicle.sensor_parameters import AXES

LARGEST = 1e12
"""Larger than any meaningful variance."""


def _diagonal(description: str, unit: str, size: int):
    about = f"variances of {description}; all 0: unknown, or of the noise of sensors"
    return parameter(about, unit, 0.0, LARGEST, size=size, default=(0.0,) * size)


@dataclasses.dataclass(frozen=True)
class ImuCovariances:
    """Diagonals (x, y, z) of the three covariances of a sensor_msgs/Imu."""

    orientation_covariance_diagonal: tuple = _diagonal("roll, pitch and yaw", "rad^2", 3)
    angular_velocity_covariance_diagonal: tuple = _diagonal("the body rates", "rad^2/s^2", 3)
    linear_acceleration_covariance_diagonal: tuple = _diagonal("specific force", "m^2/s^4", 3)

    def spread(self, numbers: np.ndarray) -> None:
        """Write them into the 37 numbers of an Imu message."""
        numbers[4:13:4] = self.orientation_covariance_diagonal
        numbers[16:25:4] = self.angular_velocity_covariance_diagonal
        numbers[28:37:4] = self.linear_acceleration_covariance_diagonal


@dataclasses.dataclass(frozen=True)
class OdomCovariances:
    """Diagonals (x, y, z and rotations about them) of both covariances of a nav_msgs/Odometry."""

    pose_covariance_diagonal: tuple = _diagonal("x, y, z, roll, pitch, yaw", "m^2, rad^2", 6)
    twist_covariance_diagonal: tuple = _diagonal("velocity and rates", "m^2/s^2, rad^2/s^2", 6)

    def spread(self, numbers: np.ndarray) -> None:
        """Write them into the 85 numbers of an Odometry message."""
        numbers[7:43:7] = self.pose_covariance_diagonal
        numbers[49:85:7] = self.twist_covariance_diagonal


@dataclasses.dataclass(frozen=True)
class Covariances:
    """The covariances of both messages, by topic."""

    imu: ImuCovariances = ImuCovariances()
    odom: OdomCovariances = OdomCovariances()


MEASURED = {
    "imu": {
        "orientation_covariance_diagonal": ("imu_orientation",),
        "angular_velocity_covariance_diagonal": ("gyro",),
        "linear_acceleration_covariance_diagonal": ("accelerometer",),
    },
    "odom": {
        "pose_covariance_diagonal": ("odom_position", "odom_orientation"),
        "twist_covariance_diagonal": ("odom_velocity", "odom_rate"),
    },
}
"""The quantities of each diagonal, which have three components each."""


def of_sensors(given: Covariances, sensors: Sensors) -> Covariances:
    """The covariances of what sensors measure; a diagonal that is given, not all 0, is kept."""
    found = {}
    for topic, diagonals in MEASURED.items():
        told = getattr(given, topic)
        missing = {
            name: tuple(sensors.variance(quantity) for quantity in quantities for _ in AXES)
            for name, quantities in diagonals.items()
            if not any(getattr(told, name)) and quantities[0] in sensors
        }
        found[topic] = dataclasses.replace(told, **missing)
    return Covariances(**found)
