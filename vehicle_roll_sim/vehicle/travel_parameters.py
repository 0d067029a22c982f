"""Parameters that say where a wheel and its carrier go with wheel travel, and their curves."""

import dataclasses

from vehicle_roll_sim.declaration import Curve, parameter
from vehicle_roll_sim.vehicle.suspension_parameters import AXLES
from vehicle_roll_sim.vehicle.travel_curves import TravelCurve

_PATH = {"unit": "m/m", "minimum": -10.0, "maximum": 10.0}
_TURN = {"unit": "rad/m", "minimum": -50.0, "maximum": 50.0}
TRAVEL_SIGNS = {
    "half_track_change": 1.0,
    "longitudinal_change": 1.0,
    "camber_change": -1.0,
    "toe_change": -1.0,
    "carrier_pitch_change": 1.0,
}
"""Parameters of each axle that are curves over wheel travel, and the sign with which they are
displacements, or rotations of a left wheel about the axes, of frame 1."""


@dataclasses.dataclass(frozen=True)
class WheelTravel:
    """The path and the turns of a wheel carrier over wheel travel, of each axle."""

    front_half_track_change: Curve | None = parameter(
        "front wheels: displacement of the contact point outwards with wheel travel (model "
        "2); by default along the line that gives the roll centre",
        **_PATH,
        default=None,
    )
    front_longitudinal_change: Curve | None = parameter(
        "front wheels: displacement of the wheel centre forwards with wheel travel (model 2); "
        "by default 0",
        **_PATH,
        default=None,
    )
    front_camber_change: Curve | None = parameter(
        "front wheels: camber with wheel travel, positive with the top outwards (model 2); by "
        "default 0",
        **_TURN,
        default=None,
    )
    front_toe_change: Curve | None = parameter(
        "front wheels: toe-in with wheel travel (14 DOF models); by default 0",
        **_TURN,
        default=None,
    )
    front_carrier_pitch_change: Curve | None = parameter(
        "front wheels: turn of the wheel carrier with wheel travel, positive with its top "
        "forwards (model 2); by default 0",
        **_TURN,
        default=None,
    )
    rear_half_track_change: Curve | None = parameter(
        "rear wheels: displacement of the contact point outwards with wheel travel (model 2); "
        "by default along the line that gives the roll centre",
        **_PATH,
        default=None,
    )
    rear_longitudinal_change: Curve | None = parameter(
        "rear wheels: displacement of the wheel centre forwards with wheel travel (model 2); "
        "by default 0",
        **_PATH,
        default=None,
    )
    rear_camber_change: Curve | None = parameter(
        "rear wheels: camber with wheel travel, positive with the top outwards (model 2); by "
        "default 0",
        **_TURN,
        default=None,
    )
    rear_toe_change: Curve | None = parameter(
        "rear wheels: toe-in with wheel travel (14 DOF models); by default 0",
        **_TURN,
        default=None,
    )
    rear_carrier_pitch_change: Curve | None = parameter(
        "rear wheels: turn of the wheel carrier with wheel travel, positive with its top "
        "forwards (model 2); by default 0",
        **_TURN,
        default=None,
    )


def curves_of(vehicle, axle: str) -> dict[str, TravelCurve]:
    """What changes with the travel of the left wheel of an axle: HALF_TRACK to CARRIER_PITCH.

    By the names of the parameters, but with the signs of rotations about the body's axes. Without
    a half-track change the contact point moves at right angles to the line from it to the roll
    centre.
    """
    return {
        f"{axle}_{name}": TravelCurve(_times(_over_travel(vehicle, axle, name), sign))
        for name, sign in TRAVEL_SIGNS.items()
    }


def _over_travel(vehicle, axle: str, name: str) -> float | tuple:
    given = getattr(vehicle, f"{axle}_{name}")
    if given is not None:
        return given
    height = vehicle.cg_height - vehicle.roll_centre_depth[AXLES[axle]]  # same for either measure
    slope = 2 * height / getattr(vehicle, f"{axle}_track")
    return slope if name == "half_track_change" else 0.0


def _times(given: float | tuple, sign: float) -> float | tuple:
    """A curve times a sign."""
    if isinstance(given, tuple):
        return tuple((travel, sign * value) for travel, value in given)
    return sign * float(given)
