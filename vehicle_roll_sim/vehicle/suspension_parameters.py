"""Parameters of each axle that describe springs, dampers, stops and steering in detail.

Declared once for both axles: `of_axle` gives the parameter of one.
"""

import dataclasses

from vehicle_roll_sim.declaration import Curve, parameter
from vehicle_roll_sim.model.records import LF, LR, STOPS

AXLES = {"front": LF, "rear": LR}
"""The left wheel of each axle; both wheels of an axle have the same parameters."""
COMPLIANCE_CAMBER = "lateral_force_camber"
LARGEST_VELOCITY = 20.0
"""m/s: of the points of a damper's table."""
_FORCE = {"unit": "N", "minimum": -1e7, "maximum": 1e7}
_CLEARANCE = {"unit": "m", "minimum": 0.0, "maximum": 2.0}
_RATIO = {"unit": "m/m", "minimum": -10.0, "maximum": 10.0}
_STOP = {"unit": "N/m", "minimum": 0.0, "maximum": 1e8}
_PROGRESSION = {"unit": "N/m^2", "minimum": 0.0, "maximum": 1e10}
_DECLARED = {
    "spring_force": (
        "spring force at one {} wheel over its compression from the unloaded spring, instead of "
        "a constant stiffness; rising",
        _FORCE | {"over": ("compression", 2.0), "alternative": "{}_spring_stiffness"},
    ),
    "damper_force": (
        "damper force at one {} wheel over the velocity of compression, instead of constant "
        "coefficients; positive in bump, 0 at 0",
        _FORCE | {"over": ("velocity", LARGEST_VELOCITY), "alternative": "{}_damping"},
    ),
    "rebound_damping": (
        "damping coefficient at one {} wheel in rebound; {}_damping is then that in bump",
        {"unit": "N s/m", "minimum": 0.0, "maximum": 1e7},
    ),
    "spring_motion_ratio": (
        "compression of a {} spring with wheel travel, if the spring is not at the wheel: a "
        "number, or a table of compression over wheel travel; by default 1",
        _RATIO,
    ),
    "damper_motion_ratio": (
        "compression of a {} damper with wheel travel, likewise; by default 1",
        _RATIO,
    ),
    "bump_stop_clearance": ("upward travel of a {} wheel from rest to its bump stop", _CLEARANCE),
    "bump_stop_stiffness": ("stiffness of the {} bump stops at contact, at the wheel", _STOP),
    "bump_stop_progression": (
        "increase of the stiffness of the {} bump stops per compression; by default 0",
        _PROGRESSION,
    ),
    "rebound_stop_clearance": (
        "downward travel of a {} wheel from rest to its rebound stop",
        _CLEARANCE,
    ),
    "rebound_stop_stiffness": ("stiffness of the {} rebound stops at contact, at the wheel", _STOP),
    "rebound_stop_progression": (
        "increase of the stiffness of the {} rebound stops per compression; by default 0",
        _PROGRESSION,
    ),
    "toe": (
        "static toe of the {} wheels, positive toe-in",
        {"unit": "rad", "minimum": -0.2, "maximum": 0.2},
    ),
    "roll_steer": (
        "steering of the {} wheels (left positive) per roll angle of the suspension (left side up "
        "positive); negative at the front and positive at the rear is understeer",
        {"unit": "rad/rad", "minimum": -2.0, "maximum": 2.0},
    ),
    "lateral_force_steer": (
        "compliance steer of a {} wheel (left positive) per lateral force (left positive); "
        "negative at the front and positive at the rear is understeer",
        {"unit": "rad/N", "minimum": -1e-2, "maximum": 1e-2},
    ),
    "aligning_moment_steer": (
        "compliance steer of a {} wheel per aligning moment, both positive to the left",
        {"unit": "rad/(N m)", "minimum": 0.0, "maximum": 1e-1},
    ),
    COMPLIANCE_CAMBER: (
        "compliance camber of a {} wheel (top to the right positive) per lateral force (left "
        "positive); positive if the wheel yields to the force",
        {"unit": "rad/N", "minimum": -1e-4, "maximum": 1e-4},
    ),
}
MOTION_RATIOS = ("spring_motion_ratio", "damper_motion_ratio")
OF_STRUTS = (
    *("spring_force", "damper_force", "rebound_damping"),
    *MOTION_RATIOS,
    *(f"{stop}_{of}" for stop in STOPS for of in ("clearance", "stiffness", "progression")),
)
OF_STEERING = ("toe", "roll_steer")
OF_COMPLIANCE = ("lateral_force_steer", "aligning_moment_steer", COMPLIANCE_CAMBER)


def of_axle(axle: str, name: str):
    """The declaration of AXLE_NAME, as a dataclass field; the parameter may be absent."""
    description, about = _DECLARED[name]
    about = dict(about)
    if "alternative" in about:
        about["alternative"] = about["alternative"].format(axle)
    return parameter(description.format(axle, axle), **about, default=None)


@dataclasses.dataclass(frozen=True)
class SuspensionDetails:
    """What each axle may have beside linear springs and dampers, and the steering of its wheels."""

    front_rebound_damping: float | None = of_axle("front", "rebound_damping")
    front_spring_motion_ratio: Curve | None = of_axle("front", "spring_motion_ratio")
    front_damper_motion_ratio: Curve | None = of_axle("front", "damper_motion_ratio")
    front_bump_stop_clearance: float | None = of_axle("front", "bump_stop_clearance")
    front_bump_stop_stiffness: float | None = of_axle("front", "bump_stop_stiffness")
    front_bump_stop_progression: float | None = of_axle("front", "bump_stop_progression")
    front_rebound_stop_clearance: float | None = of_axle("front", "rebound_stop_clearance")
    front_rebound_stop_stiffness: float | None = of_axle("front", "rebound_stop_stiffness")
    front_rebound_stop_progression: float | None = of_axle("front", "rebound_stop_progression")
    front_toe: float | None = of_axle("front", "toe")
    front_roll_steer: float | None = of_axle("front", "roll_steer")
    front_lateral_force_steer: float | None = of_axle("front", "lateral_force_steer")
    front_aligning_moment_steer: float | None = of_axle("front", "aligning_moment_steer")
    front_lateral_force_camber: float | None = of_axle("front", "lateral_force_camber")
    rear_rebound_damping: float | None = of_axle("rear", "rebound_damping")
    rear_spring_motion_ratio: Curve | None = of_axle("rear", "spring_motion_ratio")
    rear_damper_motion_ratio: Curve | None = of_axle("rear", "damper_motion_ratio")
    rear_bump_stop_clearance: float | None = of_axle("rear", "bump_stop_clearance")
    rear_bump_stop_stiffness: float | None = of_axle("rear", "bump_stop_stiffness")
    rear_bump_stop_progression: float | None = of_axle("rear", "bump_stop_progression")
    rear_rebound_stop_clearance: float | None = of_axle("rear", "rebound_stop_clearance")
    rear_rebound_stop_stiffness: float | None = of_axle("rear", "rebound_stop_stiffness")
    rear_rebound_stop_progression: float | None = of_axle("rear", "rebound_stop_progression")
    rear_toe: float | None = of_axle("rear", "toe")
    rear_roll_steer: float | None = of_axle("rear", "roll_steer")
    rear_lateral_force_steer: float | None = of_axle("rear", "lateral_force_steer")
    rear_aligning_moment_steer: float | None = of_axle("rear", "aligning_moment_steer")
    rear_lateral_force_camber: float | None = of_axle("rear", "lateral_force_camber")
    ackermann_percentage: float | None = parameter(
        "share of Ackermann geometry in the steering of the front wheels: 0 is parallel, with 100 "
        "their axes meet on that of the rear axle; by default 0",
        "%",
        -200.0,
        200.0,
        default=None,
    )
