"""Parameters of the sensors: what stands between the motion of the vehicle and a measurement."""

import dataclasses
from collections.abc import Iterable
from typing import NamedTuple

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.model.layout import WHEELS

IMU, WHEEL_SPEEDS, STEERING, ODOMETRY = "imu", "wheel_speed_sensor", "steering_sensor", "odom"
DEVICES = {
    IMU: "the inertial measurement unit",
    WHEEL_SPEEDS: "the wheel speed sensors",
    STEERING: "the steering angle sensors",
    ODOMETRY: "the odometry",
}
"""The devices, each with its own clock, delay and dropouts."""
AXES, ANGLES, TURN = ("x", "y", "z"), ("roll", "pitch", "yaw"), ("x", "y", "z", "w")
DEFAULT_PERIOD = 0.01
"""s: time between two samples of a device that says nothing else."""
SEED = "sensor_seed"
LARGEST_SEED = 2**53
"""Up to here a float is every whole number."""


class Quantity(NamedTuple):
    """What a device measures.

    prefix: of the names of its parameters. largest: that may be declared of noise, bias and
    resolution, in its unit. errors: its components as far as errors go; those of an orientation are
    small turns. values: its components in a reading. biases: endings of the parameters of its bias,
    one for all components or one for each. is_scaled, is_stepped: whether it may have a scale
    error, and a resolution.
    """

    device: str
    prefix: str
    unit: str
    largest: float
    what: str
    errors: tuple[str, ...]
    values: tuple[str, ...]
    biases: tuple[str, ...] = ()
    is_scaled: bool = True
    is_stepped: bool = True

    @property
    def is_orientation(self) -> bool:
        """Whether its values are a quaternion, with small turns as errors."""
        return self.values is TURN


def _of_imu(prefix: str, unit: str, largest: float, what: str) -> Quantity:
    return Quantity(IMU, prefix, unit, largest, what, AXES, AXES, tuple(f"_{a}" for a in AXES))


def _of_wheels(device: str, unit: str, largest: float, what: str) -> Quantity:
    return Quantity(device, device, unit, largest, what, WHEELS, WHEELS, ("",))


def _orientation(device: str, prefix: str, what: str) -> Quantity:
    turned = (ANGLES, TURN)
    return Quantity(device, prefix, "rad", 3.2, what, *turned, is_scaled=False, is_stepped=False)


QUANTITIES = {
    "accelerometer": _of_imu("accelerometer", "m/s^2", 1e3, "the specific force"),
    "gyro": _of_imu("gyro", "rad/s", 1e2, "the angular velocity"),
    "imu_orientation": _orientation(IMU, "imu_orientation", "the orientation of the imu"),
    "wheel_speed": _of_wheels(WHEEL_SPEEDS, "rad/s", 1e3, "each wheel speed"),
    "steering": _of_wheels(STEERING, "rad", 1.6, "each road-wheel angle"),
    "odom_position": Quantity(
        ODOMETRY, "odom_position", "m", 1e4, "the position", AXES, AXES, is_scaled=False
    ),
    "odom_orientation": _orientation(ODOMETRY, "odom_orientation", "the orientation in odom"),
    "odom_velocity": Quantity(
        ODOMETRY, "odom_velocity", "m/s", 1e2, "the velocity in odom", AXES, AXES
    ),
    "odom_rate": Quantity(
        ODOMETRY, "odom_rate", "rad/s", 1e2, "the angular velocity in odom", AXES, AXES
    ),
}
"""What is measured, in the order of readings."""
_PLACES = {
    **{axis: (f"place of the imu along {axis}, from the sprung c.g.", "m", 20.0) for axis in AXES},
    **{angle: (f"{angle} angle of the imu in the body, as stated", "rad", 3.2) for angle in ANGLES},
    **{
        f"misalignment_{angle}": (f"{angle} angle from there to the true attitude", "rad", 3.2)
        for angle in ANGLES
    },
}


def _of_device(device: str) -> dict[str, dataclasses.Field]:
    what = DEVICES[device]
    period = f"time between samples of {what}, a multiple of the integration step; by default "
    delay = f"delay of {what}, a multiple of its period; by default 0"
    dropout = f"share of the samples of {what} that do not arrive; by default 0"
    return {
        f"{device}_period": parameter(f"{period}{DEFAULT_PERIOD:g}", "s", 1e-6, 10.0, default=None),
        f"{device}_delay": parameter(delay, "s", 0.0, 2.0, default=None),
        f"{device}_dropout": parameter(dropout, "", 0.0, 1.0, default=None),
    }


def _of_quantity(quantity: Quantity) -> dict[str, dataclasses.Field]:
    prefix, unit, largest, what = quantity[1:5]
    noise = (f"noise density of {what}", f"{unit}/sqrt(Hz)", 0.0, largest)
    walk = (f"random walk of the bias of {what}", f"{unit}/sqrt(s)", 0.0, largest)
    found = {
        f"{prefix}_noise_density": parameter(*noise, default=None),
        f"{prefix}_bias_walk": parameter(*walk, default=None),
    }
    for ending in quantity.biases:
        along = f" along {ending[1:]}" if ending else ""
        bias = (f"constant bias of {what}{along}", unit, -largest, largest)
        found[f"{prefix}_bias{ending}"] = parameter(*bias, default=None)
    if quantity.is_scaled:
        scale = (f"{what} is measured larger by this share of it", "", -1.0, 1.0)
        found[f"{prefix}_scale_error"] = parameter(*scale, default=None)
    if quantity.is_stepped:
        steps = (f"{what} is measured in multiples of this; by default exactly", unit, 0.0, largest)
        found[f"{prefix}_resolution"] = parameter(*steps, default=None)
    return found


def parameters_of_quantity(quantity: Quantity) -> tuple[str, ...]:
    """Names of the parameters of its errors."""
    return tuple(_of_quantity(quantity))


def labels_of(names: Iterable[str]) -> tuple[str, ...]:
    """Names of the values of some of QUANTITIES."""
    return tuple(f"{name}_{value}" for name in names for value in QUANTITIES[name].values)


def _all_of(device: str) -> dict[str, dataclasses.Field]:
    found = _of_device(device)
    if device == IMU:
        for name, (meaning, unit, most) in _PLACES.items():
            found[f"{IMU}_{name}"] = parameter(meaning, unit, -most, most, default=None)
    for quantity in QUANTITIES.values():
        found |= _of_quantity(quantity) if quantity.device == device else {}
    return found


_FIELDS = {device: _all_of(device) for device in DEVICES}
OF_DEVICE = {device: tuple(fields) for device, fields in _FIELDS.items()}
"""Names of the parameters of each device."""
_OF_SEED = parameter(
    "seed of all noise, a whole number; by default 0", "", 0.0, float(LARGEST_SEED), default=None
)
Sensors = dataclasses.make_dataclass(
    "Sensors",
    [
        (name, float | None, field)
        for name, field in {
            **{n: f for fields in _FIELDS.values() for n, f in fields.items()},
            SEED: _OF_SEED,
        }.items()
    ],
    frozen=True,
    namespace={"__module__": __name__},
)
"""The sensors of a vehicle; without any value of a device its quantities are not measured."""


def has_device(vehicle, device: str) -> bool:
    """Whether any value of a device is given, even one without effect."""
    return any(name in vehicle.given for name in OF_DEVICE[device])


def devices_of(vehicle) -> tuple[str, ...]:
    """The devices that a vehicle has, in the order of DEVICES."""
    return tuple(device for device in DEVICES if has_device(vehicle, device))


def seed_of(vehicle) -> int:
    """The seed of the noise of its sensors."""
    return int(vehicle.given.get(SEED, 0))


def check_sensors(vehicle) -> None:
    """Raise InputError for a seed that is no whole number, and for one without sensors."""
    if SEED not in vehicle.given:
        return
    seed = vehicle.given[SEED]
    if seed != int(seed):
        raise InputError(SEED, seed, f"a whole number from 0 to {LARGEST_SEED}")
    if not devices_of(vehicle):
        raise InputError(SEED, seed, "no value without a sensor")
