"""The messages of a vehicle with sensors: `imu`, `odom` and `joint_states` are what these say."""

import functools
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.messages.covariances import Covariances, of_sensors
from vehicle_roll_sim.messages.joints import STEERING, WHEEL, joint_kinds, joint_motion, joint_names
from vehicle_roll_sim.messages.message_template import Encode
from vehicle_roll_sim.messages.set_templates import (
    ATTITUDE,
    IMU_ATTITUDE,
    IMU_RATES,
    POSITION,
    SPECIFIC_FORCE,
    TURNING,
    VELOCITY,
)
from vehicle_roll_sim.messages.sets import Messages
from vehicle_roll_sim.messages.topics import TRUTH
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.sensor_parameters import IMU, ODOMETRY

PARTS = {
    IMU: {"imu_orientation": IMU_ATTITUDE, "gyro": IMU_RATES, "accelerometer": SPECIFIC_FORCE},
    ODOMETRY: {
        "odom_position": POSITION,
        "odom_orientation": ATTITUDE,
        "odom_velocity": VELOCITY,
        "odom_rate": TURNING,
    },
}
"""Where the numbers of a message have what its device measures."""
IMU_FRAME = "imu_link"


class MeasuredMessages(Messages):
    """The messages of a set of a vehicle with sensors; arguments as for Messages.

    `imu` and `odom` are stamped with the time at which their reading arrived: if a sample does not
    arrive, the message before is repeated.
    """

    def __init__(
        self, simulation: Simulation, frame_prefix: str, encode: Encode, covariances: Covariances
    ):
        super().__init__(simulation, frame_prefix, encode, covariances)
        self._sensors, encoded = simulation.sensors, self._templates
        self._measurements = encoded.labelled("measurements", ("time", *self._sensors.labels))
        self._measured_joints = encoded.joint_states(joint_names(joint_kinds(simulation)))
        told = of_sensors(covariances, self._sensors)
        self._of_device = {
            IMU: encoded.inertial(IMU_FRAME, told.imu),
            ODOMETRY: encoded.odometry(told.odom),
        }

    def builder(self, topic: str) -> Callable[[], bytes]:
        if topic.startswith(TRUTH):
            return functools.partial(getattr(Messages, topic.removeprefix(TRUTH)), self)
        return super().builder(topic)

    def measurements(self) -> bytes:
        self._measurements.numbers[0] = self.simulation.time
        self._measurements.numbers[1:] = self._sensors.readings()
        return bytes(self._measurements)

    def imu(self) -> bytes:
        return self._measured(IMU) if IMU in self._sensors.devices else super().imu()

    def odom(self) -> bytes:
        return self._measured(ODOMETRY) if ODOMETRY in self._sensors.devices else super().odom()

    def _measured(self, device: str) -> bytes:
        message = self._of_device[device]
        for quantity, place in PARTS[device].items():
            message.numbers[place] = self._sensors[quantity]
        age_ns = self.simulation.time_ns - self._sensors.devices[device].arrived_ns
        seconds, nanoseconds = self.stamp
        message.stamp(*divmod(seconds * NANOSECONDS + nanoseconds - age_ns, NANOSECONDS))
        return bytes(message)

    def joint_states(self) -> bytes:
        return self._dated_joints(self._measured_joints, *self._joint_readings())

    def _joint_readings(self) -> tuple[np.ndarray, np.ndarray]:
        """Positions and velocities of all joints; steering angles and wheel speeds as measured.

        Their rates and angles are true.
        """
        (position, velocity), kinds = joint_motion(self.simulation), joint_kinds(self.simulation)
        for quantity, numbers, kind in (
            ("steering", position, STEERING),
            ("wheel_speed", velocity, WHEEL),
        ):
            if quantity in self._sensors:
                first = kinds.index(kind) * WHEEL_COUNT
                numbers[first : first + WHEEL_COUNT] = self._sensors[quantity]
        return position, velocity


def messages_of(
    simulation: Simulation,
    frame_prefix: str,
    encode: Encode,
    covariances: Covariances = Covariances(),  # noqa: B008 - it cannot be changed
) -> Messages:
    """The messages of a set, measured where the vehicle has sensors; arguments as for Messages."""
    kind = MeasuredMessages if simulation.has_sensors else Messages
    return kind(simulation, frame_prefix, encode, covariances)
