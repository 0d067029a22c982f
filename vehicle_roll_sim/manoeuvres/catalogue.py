"""Catalogue of the manoeuvres by name: those of the paper and standard test procedures."""

import dataclasses
import math
from collections.abc import Mapping

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import ADAPTED, LONGEST, STEEPEST, Manoeuvre, OpenLoop
from vehicle_roll_sim.manoeuvres.braking_in_a_turn import BRAKING_IN_A_TURN
from vehicle_roll_sim.manoeuvres.double_lane_change import (
    ISO_DOUBLE_LANE_CHANGE,
    ISO_SEVERE_DOUBLE_LANE_CHANGE,
)
from vehicle_roll_sim.manoeuvres.iso_step_steer import ISO_STEP_STEER
from vehicle_roll_sim.manoeuvres.nhtsa import NHTSA_FISHHOOK, NHTSA_J_TURN
from vehicle_roll_sim.manoeuvres.on_roads.corkscrew_ramp import CORKSCREW_RAMP
from vehicle_roll_sim.manoeuvres.on_roads.curb_trip import CURB_TRIP
from vehicle_roll_sim.manoeuvres.on_roads.random_road import RANDOM_ROAD
from vehicle_roll_sim.manoeuvres.on_roads.side_slope import SIDE_SLOPE
from vehicle_roll_sim.manoeuvres.on_roads.soil_trip import SOIL_TRIP
from vehicle_roll_sim.manoeuvres.on_roads.split_friction import SPLIT_FRICTION_BRAKING
from vehicle_roll_sim.manoeuvres.on_roads.tilt_table import TILT_TABLE
from vehicle_roll_sim.manoeuvres.sine_with_dwell import SINE_WITH_DWELL
from vehicle_roll_sim.manoeuvres.slowly_increasing_steer import SLOWLY_INCREASING_STEER
from vehicle_roll_sim.manoeuvres.steady_state_circle import (
    CONSTANT_HANDWHEEL_CIRCLE,
    CONSTANT_RADIUS_CIRCLE,
    STEADY_STATE_CIRCLE,
)
from vehicle_roll_sim.manoeuvres.wind_gust import WIND_GUST


@dataclasses.dataclass(frozen=True, kw_only=True)
class RampAndHold(OpenLoop):
    """Straight ahead, then a ramp of the road-wheel angle to a value that is held."""

    amplitude: float = parameter(
        "final road-wheel angle, left positive", "deg", -STEEPEST, STEEPEST
    )
    rate: float = parameter("rate of change of the road-wheel angle", "deg/s", 1e-3, 1e5)
    start: float = parameter("time at which steering begins", "s", 0.0, LONGEST, default=1.0)

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        turned = np.clip(self.rate * (times - self.start), 0.0, abs(self.amplitude))
        commands["steering"] = math.copysign(1.0, self.amplitude) * np.radians(turned)


PAPER = {
    "step_steer": RampAndHold(amplitude=4.0, rate=40.0, duration=4.0, speed_hold=ADAPTED),
    "ramp_steer": RampAndHold(amplitude=12.0, rate=4.0, duration=9.0),
    "j_turn": RampAndHold(amplitude=10.0, rate=40.0, duration=6.0),
}
"""The manoeuvres of Shim and Ghike (2007), under the conditions of their comparison."""
STANDARD = {
    **PAPER,
    "slowly_increasing_steer": SLOWLY_INCREASING_STEER,
    "nhtsa_j_turn": NHTSA_J_TURN,
    "nhtsa_fishhook": NHTSA_FISHHOOK,
    "sine_with_dwell": SINE_WITH_DWELL,
    "iso_step_steer": ISO_STEP_STEER,
    "iso_double_lane_change": ISO_DOUBLE_LANE_CHANGE,
    "iso_severe_double_lane_change": ISO_SEVERE_DOUBLE_LANE_CHANGE,
    "steady_state_circle": STEADY_STATE_CIRCLE,
    "constant_radius_circle": CONSTANT_RADIUS_CIRCLE,
    "constant_handwheel_circle": CONSTANT_HANDWHEEL_CIRCLE,
    "braking_in_a_turn": BRAKING_IN_A_TURN,
}
"""All manoeuvres, under the conditions of the paper or the standard (docs/manoeuvres.md)."""

ON_ROADS = {
    "tilt_table": TILT_TABLE,
    "curb_trip": CURB_TRIP,
    "soil_trip": SOIL_TRIP,
    "corkscrew_ramp": CORKSCREW_RAMP,
    "side_slope": SIDE_SLOPE,
    "random_road": RANDOM_ROAD,
    "split_friction_braking": SPLIT_FRICTION_BRAKING,
}
"""Manoeuvres that bring their own road, which a running simulator cannot be given."""
ON_ANY_ROAD = STANDARD | {"wind_gust": WIND_GUST}
"""All others; the last one only for vehicles with air forces."""
MANOEUVRES = ON_ANY_ROAD | ON_ROADS


def manoeuvre_named(name: str, known: Mapping[str, Manoeuvre] = ON_ANY_ROAD) -> Manoeuvre:
    """The manoeuvre of that name; raises InputError listing the available names.

    known: MANOEUVRES, or ON_ANY_ROAD where a manoeuvre cannot bring its own road.
    """
    if name in known:
        return known[name]
    allowed = "one of " + ", ".join(known)
    if name in ON_ROADS:
        problem = f"{name} brings its own road; drive it with `vehicle_roll_sim run`"
        raise InputError("MANOEUVRE", "", allowed, problem)
    raise InputError("MANOEUVRE", name, allowed)
