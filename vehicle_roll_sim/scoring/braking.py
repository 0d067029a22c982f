"""How a vehicle stops when it brakes on split friction."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.manoeuvres.on_roads.split_friction import STOPPED, SplitFrictionBraking
from vehicle_roll_sim.runs.history import History

WIDEST = 0.5
"""m: with a larger deviation, all wheels come onto the same surface."""
MOST_TURNED = math.radians(15.0)
"""rad: a driver does not recover from larger yaw angles."""


@dataclasses.dataclass(frozen=True)
class Braking:
    """How a vehicle stopped.

    distance: from the beginning of braking to the stop (m), nan if it does not stop. yaw (rad),
    deviation (m): largest magnitudes of the yaw angle and of the distance from the course, up to
    the stop. All nan in other tests.
    """

    distance: float = math.nan
    yaw: float = math.nan
    deviation: float = math.nan


def braking_of(manoeuvre, history: History) -> Braking:
    """How the vehicle of a run stopped; empty for other manoeuvres."""
    if not isinstance(manoeuvre, SplitFrictionBraking):
        return Braking()
    moves = np.hypot(history["u"], history["v"]) >= STOPPED
    end = len(moves) if moves.all() else int(np.argmin(moves)) + 1
    yaw, deviation = (float(np.abs(history[name][:end]).max()) for name in ("yaw", "y"))
    return Braking(float(manoeuvre.distance(history)), yaw, deviation)


def keeps_its_course(manoeuvre: SplitFrictionBraking, history: History) -> bool:
    """Whether the vehicle stops, has not turned, and is still between both surfaces."""
    found = braking_of(manoeuvre, history)
    stops = not math.isnan(found.distance)
    return stops and found.yaw <= MOST_TURNED and found.deviation <= WIDEST
