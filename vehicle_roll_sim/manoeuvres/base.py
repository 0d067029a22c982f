"""Base classes of manoeuvres: entry speed, duration, and the driver that issues the commands."""

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
"""deg; no road vehicle reaches larger road-wheel angles."""
LONGEST = 86_400.0
"""s"""
SIDES = {"left": 1.0, "right": -1.0}
"""Direction of the first steering input, and the sign of its angle."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Manoeuvre(abc.ABC):
    """A test manoeuvre: entry speed, duration, speed-hold gain, and a driver."""

    speed: float = parameter("entry speed", "m/s", 0.0, MAXIMUM_SPEED, default=DEFAULT_SPEED)
    duration: float = parameter("simulated time", "s", 0.0, LONGEST)
    speed_hold: float = parameter(
        "gain of the speed hold: drive torque at each rear wheel per m/s below the entry speed",
        "N m s/m",
        0.0,
        1e6,
        default=0.0,
    )

    needs_vehicle = False
    """Whether `for_vehicle` must be called before the manoeuvre can be driven."""
    doubts: ClassVar[list[str]] = []
    """One line for each implausible command."""
    throttle_dropped = math.inf
    """Time (s) at which the speed hold ends."""

    def __post_init__(self):
        keep_validated(self)

    @property
    def commanded(self) -> tuple[str, ...]:
        """Fields of a Command that the manoeuvre sets: steering, and torque if it holds speed."""
        return ("steering", "wheel_torque") if self.speed_hold else ("steering",)

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "Manoeuvre":
        """A copy completed with the values that depend on the vehicle and its model."""
        return self

    @abc.abstractmethod
    def driver(self) -> Programme | Feedback:
        """A new driver for one run: a function of time, or one that responds to the state."""

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        """The results of the manoeuvre, evaluated from a run: label and text of each line."""
        return {}

    def straight_ahead(self, times: np.ndarray) -> np.ndarray:
        """COMMAND records (n,) at `times` (n,) (s) that only hold the speed; no steering."""
        commands = np.zeros(len(times), COMMAND)
        commands["speed_hold_gain"] = np.where(times < self.throttle_dropped, self.speed_hold, 0.0)
        commands["speed_hold_target"] = self.speed
        return commands


@dataclasses.dataclass(frozen=True, kw_only=True)
class OpenLoop(Manoeuvre):
    """An open-loop manoeuvre: its commands are a function of time, so it is its own driver."""

    @abc.abstractmethod
    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        """Add the manoeuvre to `commands`: COMMAND records (n,), straight ahead, at `times` (s).

        Those at one time must not depend on the other times, which may be those of a whole run.
        """

    def __call__(self, times: np.ndarray) -> np.ndarray:
        """The manoeuvre as a Programme: COMMAND records (n,) at `times` (n,) (s)."""
        commands = self.straight_ahead(times)
        self.drive(times, commands)
        return commands

    def driver(self) -> Programme:
        return self
