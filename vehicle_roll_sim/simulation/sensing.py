"""The kinds of sensors: what each reads of a state and its outputs, with given errors."""

import math
from collections.abc import Callable, Iterable

import numpy as np

from vehicle_roll_sim.model.frames import quaternion
from vehicle_roll_sim.model.roll_axis import motion_above_axis
from vehicle_roll_sim.model.sensors import feel, turned
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.sensor_parameters import (
    ANGLES,
    AXES,
    IMU,
    ODOMETRY,
    STEERING,
    WHEEL_SPEEDS,
)

Erring = Callable[[np.ndarray], np.ndarray]
"""Returns what is measured in place of true numbers, in the order of the errors of a device."""
RATES = ("roll_rate", "pitch_rate", "yaw_rate")
NO_TURN = (0.0, 0.0, 0.0)


def cg_motion(state, axis_depth: float | None) -> tuple[float, ...]:
    """x, y, z of the sprung c.g. in the ground frame (m), and u, v, w in the body frame (m/s).

    state: a STATE record. axis_depth: that of the roll axis (m) in the 8 DOF model, which has no z
    and w (nan), else None.
    """
    if axis_depth is None:
        return tuple(float(state[name]) for name in ("x", "y", "z", "u", "v", "w"))
    x, y, ahead, left = motion_above_axis(state, axis_depth)
    return x, y, math.nan, ahead, left, math.nan


def attitude(state) -> tuple[float, ...]:
    """Attitude of the body as a quaternion (x, y, z, w); pitch is 0 in a model without it."""
    roll, pitch, yaw = (float(state[name]) for name in ANGLES)
    return quaternion(roll, 0.0 if math.isnan(pitch) else pitch, yaw)


class Inertial:
    """An inertial measurement unit: specific force and angular velocity along its axes, and its
    orientation. It is where it is said to be, but its attitude differs by the misalignment.

    The pitch rate of a model without one is 0.
    """

    def __init__(self, vehicle: Vehicle, _axis_depth: float | None):
        self.place, said = place_of_imu(vehicle)
        misalignment = _values(vehicle, [f"misalignment_{angle}" for angle in ANGLES])
        self.mounting = turned(quaternion(*said), quaternion(*misalignment))
        self.axes = axes_of(self.mounting)
        self.described = np.concatenate((self.place, self.mounting))

    def sense(self, state, outputs, erring: Erring) -> np.ndarray:
        rates = _or_0(np.array([state[name] for name in RATES]))
        turning = _or_0(outputs["body_acceleration"][3:].copy())
        felt = np.zeros(9)
        feel(outputs["specific_force"], rates, turning, self.place, self.axes, felt)
        found = erring(felt)
        true = turned(attitude(state), self.mounting)
        return np.concatenate((found[:6], turned(true, quaternion(*found[6:]))))


class OfWheels:
    """Sensors of one quantity at each wheel: of what `truth` has of a state and its outputs."""

    described = np.zeros(0)

    def __init__(self, truth: Callable[[np.record, np.record], np.ndarray]):
        self._truth = truth

    def sense(self, state, outputs, erring: Erring) -> np.ndarray:
        return erring(self._truth(state, outputs))


def wheel_speeds(state, _outputs) -> np.ndarray:
    """Spin velocities (rad/s), shape (4,)."""
    return state["wheel_speed"]


def steering_angles(_state, outputs) -> np.ndarray:
    """Road-wheel angles (rad), shape (4,)."""
    return outputs["steering"]


class Odometry:
    """Pose of the sprung c.g. in the ground frame, its velocity and the body rates in frame 1.

    What the model does not have is nan, as in the message without sensors.
    """

    described = np.zeros(0)

    def __init__(self, _vehicle: Vehicle, axis_depth: float | None):
        self.axis_depth = axis_depth

    def sense(self, state, outputs, erring: Erring) -> np.ndarray:
        motion, rates = cg_motion(state, self.axis_depth), [state[name] for name in RATES]
        found = erring(np.array([*motion[:3], *NO_TURN, *motion[3:], *rates]))
        orientation = turned(attitude(state), quaternion(*found[3:6]))
        return np.concatenate((found[:3], orientation, found[6:]))


KINDS = {
    IMU: Inertial,
    WHEEL_SPEEDS: lambda *_: OfWheels(wheel_speeds),
    STEERING: lambda *_: OfWheels(steering_angles),
    ODOMETRY: Odometry,
}
"""The kind of each device: made of a vehicle and the depth of its roll axis, as in `cg_motion`;
`sense` returns a reading, and `described` has the numbers that the kind depends on."""


def axes_of(orientation: tuple[float, ...]) -> np.ndarray:
    """The axes of a frame with this orientation (x, y, z, w), one a row, shape (3, 3)."""
    x, y, z, w = orientation
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
            [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
            [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _or_0(values: np.ndarray) -> np.ndarray:
    """Set what is nan to 0, in place."""
    values[np.isnan(values)] = 0.0
    return values


def place_of_imu(vehicle: Vehicle) -> tuple[np.ndarray, np.ndarray]:
    """Where the imu is said to be: from the c.g. (m), and roll, pitch and yaw in the body (rad)."""
    return _values(vehicle, AXES), _values(vehicle, ANGLES)


def _values(vehicle: Vehicle, names: Iterable[str]) -> np.ndarray:
    """Parameters of the imu; 0 if not given."""
    return np.array([vehicle.given.get(f"{IMU}_{name}", 0.0) for name in names])
