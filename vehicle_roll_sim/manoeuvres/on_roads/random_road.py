"""Random road: straight ahead on a rough road after ISO 8608, with figures of ride."""

import dataclasses

import numpy as np

from vehicle_roll_sim.manoeuvres.base import ADAPTED
from vehicle_roll_sim.manoeuvres.on_roads.ride import dynamic_load_coefficients, ride_lines
from vehicle_roll_sim.manoeuvres.on_roads.straight_course import StraightCourse
from vehicle_roll_sim.roads.profiles import RandomProfile, Roughness
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.road import Road

ROUGH_FROM = 10.0
"""m: where the road begins."""
SETTLING = 20.0
"""m: parts at the beginning and end of the full roughness that do not count in the figures."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class RandomRoadDrive(Roughness, StraightCourse):
    """At constant speed along a random road, whose middle a driver follows."""

    def __post_init__(self):
        super().__post_init__()
        self.own_road()  # it refuses what the declarations alone do not

    def own_road(self) -> Road:
        return Road(features=(RandomProfile(start=ROUGH_FROM, **self.roughness_values()),))

    def counted(self, history: History) -> np.ndarray:
        """Whether each row counts: the vehicle is on the whole roughness; shape (rows,)."""
        margin = self.run_in + SETTLING
        x = history["x"]
        return (x >= ROUGH_FROM + margin) & (x <= ROUGH_FROM + self.length - margin)

    def coefficients(self, history: History) -> np.ndarray:
        """Dynamic load coefficients of the wheels, shape (4,); nan if no row counts."""
        loads = history.wheels("normal_force")
        return dynamic_load_coefficients(loads[self.counted(history)], loads[0])

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        return ride_lines(history, self.counted(history)) | self.off_course(history)


RANDOM_ROAD = RandomRoadDrive(
    speed=80 / 3.6, duration=25.0, preview_time=0.6, roughness="C", speed_hold=ADAPTED
)
"""80 km/h on a road of class C, of which 500 m count."""
