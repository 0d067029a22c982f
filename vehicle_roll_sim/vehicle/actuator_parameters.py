"""Parameters of the actuators: what stands between a command and the quantity that acts."""

import dataclasses

from vehicle_roll_sim.declaration import InputError, parameter

QUANTITIES = {
    "steering": ("rad", 1.6, "the front steering"),
    "rear_steering": ("rad", 1.6, "the rear steering"),
    "wheel_torque": ("N m", 1e6, "each drive torque"),
    "brake_torque": ("N m", 1e6, "each brake torque"),
    "normal_force": ("N", 1e6, "each active suspension force"),
}
"""What has an actuator: its unit, the largest magnitude that may be declared, and its name."""
QUICKEST = 1e6
"""1/s: the largest rate that may be declared, over the largest magnitude."""
_DECLARED = {
    "time_constant": (
        "time constant of the first-order lag of {what}; by default none",
        {"unit": "s", "minimum": 0.0, "maximum": 100.0},
    ),
    "frequency": (
        "natural frequency of the second-order lag of {what}, in place of a time constant",
        {"unit": "Hz", "minimum": 0.001, "maximum": 1e4},
    ),
    "damping": (
        "damping ratio of this second-order lag; by default 1",
        {"unit": "", "minimum": 0.01, "maximum": 100.0},
    ),
    "dead_time": (
        "dead time of {what}, a multiple of the integration step; by default 0",
        {"unit": "s", "minimum": 0.0, "maximum": 2.0},
    ),
}
_OF_UNIT = {
    "rate_limit": "largest rate of what {what} is to follow; by default no limit",
    "range": "largest magnitude of {what}; by default no limit",
    "resolution": "{what} is commanded in multiples of this; by default exactly",
}
MEASURES = (*_DECLARED, *_OF_UNIT)
"""What an actuator is described by."""


def of_actuator(quantity: str, measure: str):
    """The declaration of one parameter of the actuator of a quantity; it may be absent."""
    unit, largest, what = QUANTITIES[quantity]
    if measure in _DECLARED:
        meaning, limits = _DECLARED[measure]
        return parameter(meaning.format(what=what), **limits, default=None)
    meaning = _OF_UNIT[measure].format(what=what)
    if measure == "rate_limit":
        limits = {"unit": f"{unit}/s", "minimum": 1e-6, "maximum": QUICKEST * largest}
    else:
        limits = {"unit": unit, "minimum": 0.0, "maximum": largest}
    return parameter(meaning, **limits, default=None)


@dataclasses.dataclass(frozen=True)
class Actuators:
    """The actuators of the commanded quantities; without any value a command acts at once."""

    steering_actuator_time_constant: float | None = of_actuator("steering", "time_constant")
    steering_actuator_frequency: float | None = of_actuator("steering", "frequency")
    steering_actuator_damping: float | None = of_actuator("steering", "damping")
    steering_actuator_dead_time: float | None = of_actuator("steering", "dead_time")
    steering_actuator_rate_limit: float | None = of_actuator("steering", "rate_limit")
    steering_actuator_range: float | None = of_actuator("steering", "range")
    steering_actuator_resolution: float | None = of_actuator("steering", "resolution")
    rear_steering_actuator_time_constant: float | None = of_actuator(
        "rear_steering", "time_constant"
    )
    rear_steering_actuator_frequency: float | None = of_actuator("rear_steering", "frequency")
    rear_steering_actuator_damping: float | None = of_actuator("rear_steering", "damping")
    rear_steering_actuator_dead_time: float | None = of_actuator("rear_steering", "dead_time")
    rear_steering_actuator_rate_limit: float | None = of_actuator("rear_steering", "rate_limit")
    rear_steering_actuator_range: float | None = of_actuator("rear_steering", "range")
    rear_steering_actuator_resolution: float | None = of_actuator("rear_steering", "resolution")
    wheel_torque_actuator_time_constant: float | None = of_actuator("wheel_torque", "time_constant")
    wheel_torque_actuator_frequency: float | None = of_actuator("wheel_torque", "frequency")
    wheel_torque_actuator_damping: float | None = of_actuator("wheel_torque", "damping")
    wheel_torque_actuator_dead_time: float | None = of_actuator("wheel_torque", "dead_time")
    wheel_torque_actuator_rate_limit: float | None = of_actuator("wheel_torque", "rate_limit")
    wheel_torque_actuator_range: float | None = of_actuator("wheel_torque", "range")
    wheel_torque_actuator_resolution: float | None = of_actuator("wheel_torque", "resolution")
    brake_torque_actuator_time_constant: float | None = of_actuator("brake_torque", "time_constant")
    brake_torque_actuator_frequency: float | None = of_actuator("brake_torque", "frequency")
    brake_torque_actuator_damping: float | None = of_actuator("brake_torque", "damping")
    brake_torque_actuator_dead_time: float | None = of_actuator("brake_torque", "dead_time")
    brake_torque_actuator_rate_limit: float | None = of_actuator("brake_torque", "rate_limit")
    brake_torque_actuator_range: float | None = of_actuator("brake_torque", "range")
    brake_torque_actuator_resolution: float | None = of_actuator("brake_torque", "resolution")
    normal_force_actuator_time_constant: float | None = of_actuator("normal_force", "time_constant")
    normal_force_actuator_frequency: float | None = of_actuator("normal_force", "frequency")
    normal_force_actuator_damping: float | None = of_actuator("normal_force", "damping")
    normal_force_actuator_dead_time: float | None = of_actuator("normal_force", "dead_time")
    normal_force_actuator_rate_limit: float | None = of_actuator("normal_force", "rate_limit")
    normal_force_actuator_range: float | None = of_actuator("normal_force", "range")
    normal_force_actuator_resolution: float | None = of_actuator("normal_force", "resolution")


def name_of(quantity: str, measure: str) -> str:
    """The name of a parameter."""
    return f"{quantity}_actuator_{measure}"


OF_ACTUATORS = tuple(name_of(quantity, each) for quantity in QUANTITIES for each in MEASURES)
"""The names of all parameters of actuators."""


def has_actuator(vehicle, quantity: str) -> bool:
    """Whether any value of the actuator of a quantity is given, even one without effect."""
    return any(name_of(quantity, measure) in vehicle.given for measure in MEASURES)


def has_actuators(vehicle) -> bool:
    """Whether any quantity has an actuator."""
    return not vehicle.given.keys().isdisjoint(OF_ACTUATORS)


def refuse_actuators(vehicle, allowed: str) -> None:
    """Raise InputError for the first value of an actuator. allowed: what is, in words."""
    for name in OF_ACTUATORS:
        if name in vehicle.given:
            raise InputError(vehicle.stated_at.get(name, name), vehicle.given[name], allowed)


def check_actuators(vehicle) -> None:
    """Raise InputError for two lags of one actuator, and for a damping ratio of none."""
    for quantity in QUANTITIES:
        first, second = name_of(quantity, "time_constant"), name_of(quantity, "frequency")
        damping = name_of(quantity, "damping")
        if first in vehicle.given and second in vehicle.given:
            value = vehicle.given[first]
            problem = f"{value:g} together with {second} {vehicle.given[second]:g}"
            raise InputError(first, value, "only one of the two may be given", problem)
        if damping in vehicle.given and second not in vehicle.given:
            raise InputError(damping, vehicle.given[damping], f"no value without a {second}")
