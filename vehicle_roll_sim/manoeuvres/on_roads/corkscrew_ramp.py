"""Corkscrew ramp: the wheels of one side drive up a ramp, and drop from its end."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import ADAPTED, SIDES
from vehicle_roll_sim.manoeuvres.on_roads.straight_course import StraightCourse
from vehicle_roll_sim.roads.heights import CorkscrewRamp
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import LEFT, RIGHT
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.parameters import Vehicle

RAMP_FROM = 20.0
"""m: where the ramp begins."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class CorkscrewRampDrive(StraightCourse):
    """Straight ahead at constant speed over a ramp under the wheels of one side."""

    ramp_height: float = parameter("height of the end of the ramp", "m", 0.001, 10.0, default=0.6)
    ramp_length: float = parameter("length of its rise", "m", 0.1, 1000.0, default=8.0)
    ramp_top: float = parameter(
        "length of its level top, before the drop", "m", 0.0, 1000.0, default=0.0
    )
    ramp_edge: float = parameter(
        "distance from the course at which its full height is reached; less than half the track",
        "m",
        0.001,
        10.0,
        default=0.5,
    )
    side: str = parameter("side that is raised", choices=tuple(SIDES), default="left")

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "CorkscrewRampDrive":
        """As for any driver; raises InputError if no wheel reaches the height of the ramp."""
        least = float(np.abs(vehicle.wheel_places).min())
        if not self.ramp_edge < least:
            allowed = f"less than the {least:g} m from the course to the wheels"
            raise InputError("ramp_edge", self.ramp_edge, allowed)
        return super().for_vehicle(vehicle, options)

    def own_road(self) -> Road:
        ramp = CorkscrewRamp(
            start=RAMP_FROM,
            length=self.ramp_length,
            height=self.ramp_height,
            width=self.ramp_edge,
            raised=self.side,
            top=self.ramp_top,
        )
        return Road(features=(ramp,))

    def time_in_the_air(self, history: History) -> float:
        """The longest time (s) for which both wheels of the raised side carry no load."""
        raised = LEFT if self.side == "left" else RIGHT
        off = (history.wheels("normal_force")[:, raised] <= 0.0).all(axis=1)
        edges = np.flatnonzero(np.diff(np.concatenate(([0], off.astype(int), [0]))))
        time = history["time"]
        last = len(time) - 1
        spans = [time[min(end, last)] - time[begin] for begin, end in edges.reshape(-1, 2)]
        return max(map(float, spans), default=0.0)

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        rate = math.degrees(np.abs(history["roll_rate"]).max())
        return {
            "peak roll rate": f"{rate:.3f} deg/s",
            "raised side in the air for": f"{self.time_in_the_air(history):.3f} s",
            **self.off_course(history),
        }


CORKSCREW_RAMP = CorkscrewRampDrive(
    speed=50 / 3.6, duration=6.0, preview_time=0.6, speed_hold=ADAPTED
)
"""50 km/h over a ramp of 0.6 m under the left wheels."""
