"""Side slope: along a bank, by a driver who holds the course or with the steering wheel fixed."""

import dataclasses
import math
from collections.abc import Mapping

import numpy as np

from vehicle_roll_sim.declaration import parameter, parameters_of
from vehicle_roll_sim.manoeuvres.base import ADAPTED, SIDES
from vehicle_roll_sim.manoeuvres.driver.path_following import DriverSettings
from vehicle_roll_sim.manoeuvres.on_roads.straight_course import StraightCourse
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import load_transfer_ratio, steady
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.steering_gear import to_handwheel

DRIVER, FIXED = "driver", "fixed"
ROUNDING = 1e-9
"""s"""
WINDOW = 0.5
"""s: figures are means over this time at the end."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class SideSlopeDrive(StraightCourse):
    """At constant speed along a slope that rises to one side, from the equilibrium of a level road.

    Gravity turns into the slope at the start, which rocks the vehicle; the report is on the end.
    """

    slope: float = parameter("angle of the slope", "deg", 0.0, 45.0, default=15.0)
    side: str = parameter("side to which it rises", choices=tuple(SIDES), default="left")
    steered_by: str = parameter(
        "a driver who holds the course, or fixed: wheels straight ahead, and the vehicle drifts",
        choices=(DRIVER, FIXED),
        default=DRIVER,
    )

    @property
    def without_effect(self) -> Mapping[str, str]:
        names = parameters_of(DriverSettings) if self.steered_by == FIXED else ()
        return dict.fromkeys(names, f"only if steered_by is {DRIVER}")

    def own_road(self) -> Road:
        return Road(bank=SIDES[self.side] * math.tan(math.radians(self.slope)))

    def driver(self) -> Programme | Feedback:
        return self.straight_ahead if self.steered_by == FIXED else super().driver()

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        time = history["time"]
        if time[-1] < self.duration - ROUNDING:
            return {"steady driving": "none: the run ended early"}
        if self.duration < WINDOW:
            return {"steady driving": "unknown: the run is too short"}
        steering = math.degrees(steady(time, history["steering"], WINDOW))
        ratio = steady(time, load_transfer_ratio(history.wheels("normal_force")), WINDOW)
        sideslip = math.degrees(steady(time, np.arctan2(history["v"], history["u"]), WINDOW))
        return {
            "steady handwheel angle": f"{float(to_handwheel(steering, self.gear)):.3f} deg",
            "steady sideslip angle": f"{sideslip:.3f} deg",
            "steady load transfer ratio": f"{ratio:.4f}",
            "drift": f"{history['y'][-1]:.3f} m",
        }


SIDE_SLOPE = SideSlopeDrive(speed=10.0, duration=10.0, preview_time=0.6, speed_hold=ADAPTED)
"""36 km/h along a slope of 15 degrees."""
