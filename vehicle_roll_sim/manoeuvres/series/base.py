"""Base class of test series: runs of a manoeuvre to the left and to the right."""

import abc
import contextlib
import dataclasses
from collections.abc import Iterator
from contextvars import ContextVar

import numpy as np

from vehicle_roll_sim.manoeuvres.base import SIDES, Manoeuvre
from vehicle_roll_sim.manoeuvres.driving import history_of
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle

COMPLETE = "complete"
_KEPT: ContextVar[list["DrivenRun"] | None] = ContextVar("kept runs", default=None)
_ROAD: ContextVar[Road | None] = ContextVar("road", default=None)


@dataclasses.dataclass(frozen=True)
class Series(abc.ABC):
    """Runs of a manoeuvre to the left, then to the right; each gives one row of results."""

    manoeuvre: Manoeuvre

    columns = ()
    """Names of the columns; values are in SI units unless the name ends in a unit."""
    settings = ()
    """Pairs of a title and a declaring class, or instance with defaults: the series' options."""

    def with_values(self, values: dict) -> "Series":
        """A copy with some of these options replaced."""
        return dataclasses.replace(self, manoeuvre=self.manoeuvre.with_values(values))

    def rows(self, vehicle: Vehicle, options: Options) -> Iterator[tuple]:
        """Drive the runs one by one; yields a row per run, direction first."""
        ready = self.manoeuvre.for_vehicle(vehicle, options)
        for direction in SIDES:
            for row in self.rows_to_a_side(ready, direction, vehicle, options):
                yield (direction, *row)

    @abc.abstractmethod
    def rows_to_a_side(
        self, ready: Manoeuvre, direction: str, vehicle: Vehicle, options: Options
    ) -> Iterator[tuple]:
        """Drive the runs to one side; yields rows without the direction."""

    def remarks(self, vehicle: Vehicle, rows: list[tuple]) -> dict[str, str]:
        """Further remarks on the results: label and text of each line."""
        return {}

    @abc.abstractmethod
    def verdict(self, rows: list[tuple]) -> str:
        """The conclusion from the rows, in one line."""


@dataclasses.dataclass(frozen=True)
class DrivenRun:
    """A run of a series: the manoeuvre as driven, all rows, and its EVENTS record."""

    manoeuvre: Manoeuvre
    history: History
    events: np.record


@contextlib.contextmanager
def kept_runs() -> Iterator[list[DrivenRun]]:
    """Within the context, the runs of every series are added to the list that it yields.

    Otherwise only their rows of results are kept. There is one run for each row, in the same order.
    """
    kept: list[DrivenRun] = []
    before = _KEPT.set(kept)
    try:
        yield kept
    finally:
        _KEPT.reset(before)


@contextlib.contextmanager
def on_road(road: Road | None) -> Iterator[None]:
    """Within the context, every series is driven on this road; None is the level plane."""
    before = _ROAD.set(road)
    try:
        yield
    finally:
        _ROAD.reset(before)


def driven(manoeuvre: Manoeuvre, vehicle: Vehicle, options: Options) -> tuple[Simulation, History]:
    """Drive a manoeuvre, completed by `for_vehicle`, in a new simulation."""
    simulation = Simulation(vehicle, options, road=_ROAD.get())
    simulation.reset(manoeuvre.speed)
    history = history_of(simulation, manoeuvre.driver(), manoeuvre.duration)
    if (kept := _KEPT.get()) is not None:
        kept.append(DrivenRun(manoeuvre, history, simulation.events.copy()))
    return simulation, history


def ending_of(simulation: Simulation) -> str:
    """How a run ended, in one word."""
    is_complete = simulation.condition is Condition.RUNNING
    return COMPLETE if is_complete else simulation.condition.name.lower()
