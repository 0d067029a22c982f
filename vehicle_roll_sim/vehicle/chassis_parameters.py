"""Parameters of roll centres, steering gear, resistance to motion, camber and anti-roll bars."""

import dataclasses

from vehicle_roll_sim.declaration import Table, parameter

ROLL_CENTRES = {"minimum": -5.0, "maximum": 50.0}
"""m: allowed range of the depth, and of the height, of a roll centre."""
_CENTRE = {"unit": "m"} | ROLL_CENTRES
_CAMBER = {"unit": "rad", "minimum": -0.5, "maximum": 0.5}
_ROLL_STIFFNESS = {"unit": "N m/rad", "minimum": 0.0, "maximum": 1e8}
_BAR = {"unit": "N/m", "minimum": 0.0, "maximum": 1e8}


@dataclasses.dataclass(frozen=True)
class Chassis:
    """What joins the wheels of an axle, and what slows the vehicle down."""

    front_roll_centre_depth: float | None = parameter(
        "depth of the front roll centre below the c.g. of the sprung mass",
        **_CENTRE,
        symbol="hrcf",
        alternative="front_roll_centre_height",
    )
    front_roll_centre_height: float | None = parameter(
        "height of the front roll centre above ground at rest, instead of its depth",
        **_CENTRE,
        alternative="front_roll_centre_depth",
    )
    rear_roll_centre_depth: float | None = parameter(
        "depth of the rear roll centre below the c.g. of the sprung mass",
        **_CENTRE,
        symbol="hrcr",
        alternative="rear_roll_centre_height",
    )
    rear_roll_centre_height: float | None = parameter(
        "height of the rear roll centre above ground at rest, instead of its depth",
        **_CENTRE,
        alternative="rear_roll_centre_depth",
    )
    steering_ratio: float | None = parameter(
        "ratio of handwheel angle to road-wheel angle",
        minimum=0.1,
        maximum=100.0,
        alternative="steering_gear",
    )
    steering_gear: Table | None = parameter(
        "road-wheel angle over handwheel angle, instead of a constant steering ratio; rising, 0 "
        "at 0",
        "rad",
        -3.0,
        3.0,
        over=("handwheel angle", 50.0),
        alternative="steering_ratio",
    )
    minimum_relaxation_length: float = parameter(
        "lower limit of the tires' relaxation lengths", "m", 0.01, 5.0, default=0.1
    )
    rolling_resistance_coefficient: float = parameter(
        "ratio of a wheel's rolling resistance to its normal load", "", 0.0, 1.0, default=0.0
    )
    drag_area: float = parameter(
        "drag coefficient times frontal area", "m^2", 0.0, 100.0, default=0.0
    )
    front_camber: float = parameter(
        "static camber of the front wheels, positive with their tops outwards",
        **_CAMBER,
        default=0.0,
    )
    rear_camber: float = parameter(
        "static camber of the rear wheels, positive with their tops outwards",
        **_CAMBER,
        default=0.0,
    )
    front_anti_roll_bar_stiffness: float | None = parameter(
        "roll stiffness of the front anti-roll bar, between body and road; by default 0",
        **_ROLL_STIFFNESS,
        default=None,
    )
    front_anti_roll_bar_rate: float | None = parameter(
        "the same at the wheels: force on each per difference of their travels",
        **_BAR,
        default=None,
    )
    rear_anti_roll_bar_stiffness: float | None = parameter(
        "roll stiffness of the rear anti-roll bar, between body and road; by default 0",
        **_ROLL_STIFFNESS,
        default=None,
    )
    rear_anti_roll_bar_rate: float | None = parameter(
        "the same at the wheels: force on each per difference of their travels",
        **_BAR,
        default=None,
    )
