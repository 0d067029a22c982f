"""Braking on split friction: one side is slippery, and a driver keeps the vehicle straight."""

import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.base import LONGEST, SIDES
from vehicle_roll_sim.manoeuvres.on_roads.straight_course import StraightCourse
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.roads.surfaces import LARGEST_FRICTION, Patch
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.road import Road

BEHIND = -1000.0
"""m: where the slippery side begins."""
STOPPED = 0.1
"""m/s"""
LARGEST_TORQUE = 1e5
"""N m"""


def _torque(description: str, default: float):
    return parameter(description, "N m", 0.0, LARGEST_TORQUE, default=default)


@dataclasses.dataclass(frozen=True, kw_only=True)
class SplitFrictionBraking(StraightCourse):
    """Straight ahead at the entry speed, then constant brake torques until the vehicle stops."""

    low_friction: float = parameter(
        "factor on LMUX and LMUY of the tires on the slippery side",
        "",
        0.0,
        LARGEST_FRICTION,
        default=0.1,
    )
    side: str = parameter("side that is slippery", choices=tuple(SIDES), default="right")
    front_brake_torque: float = _torque("brake torque at each front wheel", 600.0)
    rear_brake_torque: float = _torque("brake torque at each rear wheel", 300.0)
    start: float = parameter("time at which braking begins", "s", 0.0, LONGEST, default=1.0)

    @property
    def commanded(self) -> tuple[str, ...]:
        return (*super().commanded, "brake_torque")

    def own_road(self) -> Road:
        edge = "right" if self.side == "left" else "left"
        return Road(features=(Patch(start=BEHIND, friction=self.low_friction, **{edge: 0.0}),))

    def act(self, time: float, commands: np.ndarray) -> None:
        if time >= self.start:
            axles = (self.front_brake_torque, self.rear_brake_torque)
            commands["speed_hold_gain"] = 0.0
            commands["brake_torque"] = np.repeat(axles, len(WHEELS) // len(axles))

    def distance(self, history: History) -> float:
        """Distance (m) from the beginning of braking to the stop; nan if it does not stop."""
        time, stopped = history["time"], np.hypot(history["u"], history["v"]) < STOPPED
        if not stopped.any():
            return np.nan
        x, end = history["x"], int(np.argmax(stopped))
        return float(x[end] - np.interp(self.start, time, x))

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        distance = self.distance(history)
        stop = "does not stop" if np.isnan(distance) else f"{distance:.3f} m"
        return {"stopping distance": stop, **self.off_course(history)}


SPLIT_FRICTION_BRAKING = SplitFrictionBraking(speed=20.0, duration=15.0, preview_time=0.6)
"""From 72 km/h, with the right wheels on a slippery surface."""
