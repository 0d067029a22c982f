"""Every quantity that a log may have: unit, sign and the largest plausible magnitude."""

import math
from typing import NamedTuple

from vehicle_roll_sim.model.records import WHEELS


class Quantity(NamedTuple):
    """unit: SI or rad. largest: larger magnitudes are refused as a wrong unit. lowest: smaller
    values are. least: a smaller measured peak is too small to be judged. flips: whether the sign is
    the opposite with y to the right and z down. meaning: as the documentation has it.
    """

    unit: str
    largest: float
    meaning: str
    least: float = 0.0
    lowest: float = -math.inf
    flips: bool = False


def _angle(meaning: str, largest: float, least: float = 0.0, flips: bool = True) -> Quantity:
    return Quantity("rad", math.radians(largest), meaning, math.radians(least), flips=flips)


def _rate(meaning: str, flips: bool) -> Quantity:
    return Quantity("rad/s", 12.0, meaning, math.radians(1.0), flips=flips)


def _of_wheels(name: str, *given, **named) -> dict[str, Quantity]:
    return {f"{name}_{wheel}": Quantity(*given, **named) for wheel in WHEELS}


TIME = "time"
TIMING = {TIME: Quantity("s", math.inf, "time of the row; any origin")}
STEERING = {
    "steering": _angle("front road-wheel angle, left positive", 80.0),
    "handwheel": _angle("handwheel angle, left positive; the vehicle's gear applies", 1500.0),
    "rear_steering": _angle("rear road-wheel angle, left positive", 80.0),
}
TORQUES = {
    "drive_torque": Quantity("N m", 1e5, "total drive torque at the wheels"),
    "brake": Quantity("N m", 1e6, "total brake torque at the wheels", lowest=0.0),
    **_of_wheels("wheel_torque", "N m", 1e5, "drive torque at the wheel"),
    **_of_wheels("brake_torque", "N m", 1e6, "brake torque at the wheel", lowest=0.0),
}
SPEED = "speed"
MEASURED = {
    SPEED: Quantity("m/s", 100.0, "forward speed at the c.g.", 1.0),
    "yaw_rate": _rate("yaw rate, left positive", flips=True),
    "lateral_acceleration": Quantity(
        "m/s^2", 50.0, "lateral acceleration, left positive", 0.3, flips=True
    ),
    "sideslip_angle": _angle("angle from the heading to the velocity, left positive", 180.0, 0.3),
    "roll": _angle("roll angle, left side up positive", 180.0, 0.3, flips=False),
    "roll_rate": _rate("roll rate, left side up positive", flips=False),
    "pitch_rate": _rate("pitch rate, nose down positive; only for places of sensors", flips=True),
    **_of_wheels("normal_force", "N", 2e5, "normal load of the tire", 100.0),
}
QUANTITIES = TIMING | STEERING | TORQUES | MEASURED
COMPARED = tuple(name for name in MEASURED if name not in (SPEED, "pitch_rate"))
"""Compared wherever the log has them; the speed only if it is not held."""
PLACED = ("lateral_acceleration", "sideslip_angle")
"""Quantities that depend on the place of their sensor."""
ACCELERATION = "lateral_acceleration"
BODY, LEVEL = FRAMES = ("body", "level")
"""Of an acceleration: along the axes of the body and with gravity, as an accelerometer reads it; or
in the horizontal plane."""
