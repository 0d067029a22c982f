"""Base classes of manoeuvres: entry speed, duration, and the driver that issues the commands."""

import abc
import dataclasses
import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from vehicle_roll_sim.declaration import InputError, keep_validated, parameter
from vehicle_roll_sim.model.records import COMMAND, LR
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import DEFAULT_SAMPLE
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.limits import DEFAULT_SPEED, MAXIMUM_SPEED
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.parameters import Vehicle

STEEPEST = 60.0
"""deg; no road vehicle reaches larger road-wheel angles."""
LONGEST = 86_400.0
"""s"""
ADAPTED = None
"""Speed-hold gain of the standard manoeuvres: `hold_for` gives its value for the vehicle."""
REFERENCE_HOLD = 2000.0
"""N m s/m: speed-hold gain for the reference vehicle; keeps its speed within a few cm/s of the
entry speed."""
REFERENCE_MASS, REFERENCE_RADIUS = 1760.0, 0.285
"""kg and m: of the reference vehicle, and of its rear tires."""
ROUNDING = 1e-9
"""s"""
SIDES = {"left": 1.0, "right": -1.0}
"""Direction of the first steering input, and the sign of its angle."""


def hold_for(vehicle: Vehicle) -> float:
    """The speed-hold gain (N m s/m) with which an error of speed fades as in the reference vehicle.

    Its rate is 2 gain / (mass * radius), about 8 per second.
    """
    radius = float(vehicle.per_wheel("tire_radius")[LR])
    return REFERENCE_HOLD * (vehicle.mass * radius / (REFERENCE_MASS * REFERENCE_RADIUS))


@dataclasses.dataclass(frozen=True, kw_only=True)
class Manoeuvre(abc.ABC):
    """A test manoeuvre: entry speed, duration, speed-hold gain, and a driver.

    `for_vehicle` replaces a speed-hold gain of ADAPTED by the gain from `hold_for`.
    """

    speed: float = parameter("entry speed", "m/s", 0.0, MAXIMUM_SPEED, default=DEFAULT_SPEED)
    duration: float = parameter("simulated time", "s", 0.0, LONGEST)
    speed_hold: float | None = parameter(
        "gain of the speed hold: drive torque at each rear wheel per m/s below the entry speed",
        "N m s/m",
        0.0,
        1e6,
        none="adapted to the vehicle",
        default=0.0,
    )

    doubts: ClassVar[list[str]] = []
    """One line for each implausible command."""
    throttle_dropped = math.inf
    """Time (s) at which the speed hold ends."""

    def __post_init__(self):
        keep_validated(self)

    @property
    def without_effect(self) -> Mapping[str, str]:
        """Parameters that the values of others leave without effect, and when they have one."""
        return {}

    def with_values(self, values: Mapping) -> "Manoeuvre":
        """A copy with other values of some parameters; raises InputError.

        It is also raised for values without effect: nothing that is asked for is ignored.
        """
        manoeuvre = dataclasses.replace(self, **values)
        for name, condition in manoeuvre.without_effect.items():
            if name in values:
                raise InputError(name, values[name], condition)
        return manoeuvre

    @property
    def needs_vehicle(self) -> bool:
        """Whether `for_vehicle` must be called before the manoeuvre can be driven."""
        return self.speed_hold is ADAPTED

    @property
    def commanded(self) -> tuple[str, ...]:
        """Fields of a Command that the manoeuvre sets: steering, and torque if it holds speed."""
        return ("steering", "wheel_torque") if self.speed_hold != 0.0 else ("steering",)

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "Manoeuvre":
        """A copy completed with the values that depend on the vehicle and its model."""
        if self.speed_hold is not ADAPTED:
            return self
        return dataclasses.replace(self, speed_hold=hold_for(vehicle))

    def check_road(self, road: Road) -> None:  # noqa: B027, most are driven on every road
        """Raise InputError if the manoeuvre cannot be driven on a road."""

    @abc.abstractmethod
    def driver(self) -> Programme | Feedback:
        """A new driver for one run: a function of time, or one that responds to the state."""

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        """The results of the manoeuvre, evaluated from a run: label and text of each line."""
        return {}

    def results(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        """The `report`, and a line on the samples if they are further apart than usual."""
        report, interval = self.report(history, driver), history.interval
        if report and interval > DEFAULT_SAMPLE + ROUNDING:
            usual = f"instead of the usual {DEFAULT_SAMPLE:g} s"
            report = {**report, "figures": f"from samples {interval:g} s apart {usual}"}
        return report

    def straight_ahead(self, times: np.ndarray) -> np.ndarray:
        """COMMAND records (n,) at `times` (n,) (s) that only hold the speed; no steering.

        Raises InputError for an ADAPTED gain, before `for_vehicle`.
        """
        gain = self.speed_hold
        if gain is ADAPTED:
            allowed = "a gain, or a manoeuvre completed by for_vehicle(vehicle, options)"
            raise InputError("speed_hold", gain, allowed)
        commands = np.zeros(len(times), COMMAND)
        commands["speed_hold_gain"] = np.where(times < self.throttle_dropped, gain, 0.0)
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
