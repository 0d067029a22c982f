"""What every manoeuvre has: speed at entry, length, and a driver for a vehicle."""

import abc
import dataclasses
import math
from typing import ClassVar

import numpy as np

from vehicle_roll_sim.declaration import keep_validated, parameter
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import DEFAULT_SPEED, MAXIMUM_SPEED
from vehicle_roll_sim.vehicle.parameters import Vehicle

STEEPEST = 60.0
"""deg: road-wheel angles beyond it belong to no road vehicle."""
LONGEST = 86_400.0
"""s"""
SIDES = {"left": 1.0, "right": -1.0}
"""To which a manoeuvre begins, and the sign of its first turn."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Manoeuvre(abc.ABC):
    """Speed at entry, length and speed hold: what every manoeuvre has."""

    speed: float = parameter("speed at entry", "m/s", 0.0, MAXIMUM_SPEED, default=DEFAULT_SPEED)
    duration: float = parameter("simulated time", "s", 0.0, LONGEST)
    speed_hold: float = parameter(
        "torque at each rear wheel per m/s below the entry speed",
        "N m s/m",
        0.0,
        1e6,
        default=0.0,
    )

    needs_vehicle = False
    """Whether it is driven only after `for_vehicle`."""
    doubts: ClassVar[list[str]] = []
    """What is not plausible of its commands, a line each."""
    throttle_dropped = math.inf
    """Time (s) from which on the speed is not held any more."""

    def __post_init__(self):
        keep_validated(self)

    @property
    def commanded(self) -> tuple[str, ...]:
        """Fields of a Command that it has a say in: steering, and what holds the speed."""
        return ("steering", "wheel_torque") if self.speed_hold else ("steering",)

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "Manoeuvre":
        """The manoeuvre with what depends on the vehicle and its model filled in."""
        return self

    @abc.abstractmethod
    def driver(self) -> Programme | Feedback:
        """Whoever drives one run."""

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        """What the manoeuvre is driven for, read off a run: label and text of each line."""
        return {}

    def straight_ahead(self, times: np.ndarray) -> np.ndarray:
        """COMMAND records for `times` (s) that hold the speed and do no more."""
        commands = np.zeros(len(times), COMMAND)
        commands["speed_hold_gain"] = np.where(times < self.throttle_dropped, self.speed_hold, 0.0)
        commands["speed_hold_target"] = self.speed
        return commands


@dataclasses.dataclass(frozen=True, kw_only=True)
class OpenLoop(Manoeuvre):
    """A manoeuvre that is a function of time: it is its own driver."""

    @abc.abstractmethod
    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        """Fill in `commands`, straight ahead so far, a COMMAND record for each of `times` (s)."""

    def __call__(self, times: np.ndarray) -> np.ndarray:
        """The manoeuvre as a Programme: one COMMAND record for each of `times` (s)."""
        commands = self.straight_ahead(times)
        self.drive(times, commands)
        return commands

    def driver(self) -> Programme:
        return self
