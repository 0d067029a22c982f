"""Manoeuvres in which a driver keeps to the x axis of a road that the manoeuvre brings."""

import dataclasses

import numpy as np

from vehicle_roll_sim.manoeuvres.driver.path_following import PathFollowing
from vehicle_roll_sim.manoeuvres.on_roads.own_road import OnOwnRoad
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback


@dataclasses.dataclass(frozen=True, kw_only=True)
class StraightCourse(PathFollowing, OnOwnRoad):
    """A driver follows the initial course."""

    def path_ahead(self, x: float, y: float, distance: float) -> np.ndarray:
        return np.array([(x, 0.0), (x + 2.0 * distance, 0.0)])

    def act(self, time: float, commands: np.ndarray) -> None:
        """Add to `commands`, one COMMAND record, what is done at `time` (s) besides steering."""

    def driver(self) -> Feedback:
        return CourseDriver(self)

    def off_course(self, history: History) -> dict[str, str]:
        """The line of the report on how well the driver keeps to the course."""
        return {"deviation from the course": f"{np.abs(history['y']).max():.3f} m"}


class CourseDriver(Feedback):
    """Steers along the course, and does what the manoeuvre requires."""

    def __init__(self, manoeuvre: StraightCourse):
        self.manoeuvre, self.steering = manoeuvre, manoeuvre.steering()

    def command(self, time: float, state) -> np.ndarray:
        commands = self.manoeuvre.straight_ahead(np.array([time]))
        self.manoeuvre.act(time, commands)
        commands["steering"] = self.steering.angle(time, state)
        return commands
