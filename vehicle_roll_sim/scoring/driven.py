"""Runs as they were driven: the commands of every period, from which a run is repeated."""

import dataclasses
import io

import numpy as np

from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import Observer, run
from vehicle_roll_sim.scoring.plan import Ladder, Setup
from vehicle_roll_sim.simulation.command import Command, Feedback, Programme, held_command
from vehicle_roll_sim.simulation.simulation import Simulation

ROUNDING = 1e-9
"""s"""
NOBODY_WARNS = np.zeros(0, bool)


@dataclasses.dataclass(frozen=True, eq=False)
class Driven:
    """A run with a controller.

    commands: COMMAND records given in each period, shape (n,). warned: whether each set was
    answered with a warning, shape (n + 1,), or (0,) if nothing warns. notes: what happened to
    commands that were not applied as they came, one line each.
    """

    commands: np.ndarray
    warned: np.ndarray
    notes: tuple[str, ...] = ()

    def __eq__(self, other) -> bool:
        return self.to_bytes() == other.to_bytes()

    def to_bytes(self) -> bytes:
        """The content of a file from which `from_bytes` makes it again."""
        content = io.BytesIO()
        numbers = self.commands.view(np.float64).reshape(len(self.commands), -1)
        notes = np.array(self.notes, dtype=np.str_)
        np.savez_compressed(content, commands=numbers, warned=self.warned, notes=notes)
        return content.getvalue()

    @classmethod
    def from_bytes(cls, content: bytes) -> "Driven":
        """Raises ValueError or an exception of numpy for anything else than such a file."""
        with np.load(io.BytesIO(content)) as arrays:
            numbers = np.ascontiguousarray(arrays["commands"])
            notes = tuple(map(str, arrays["notes"]))
            return cls(numbers.view(COMMAND).reshape(len(numbers)), arrays["warned"], notes)


class GivenCommands(Feedback):
    """The commands of a driven run, period by period."""

    def __init__(self, commands: np.ndarray):
        self._commands, self._next = commands, 0

    def command(self, time: float, state) -> Command:
        self._next += 1
        return held_command(self._commands[self._next - 1], 0.0)


@dataclasses.dataclass(frozen=True)
class Outcome:
    """A run: its manoeuvre, history with commands, EVENTS record and how it ended.

    warned: as in Driven, one for each row of the history if anything warns. has_failed: by the
    criterion of its test.
    """

    manoeuvre: Manoeuvre
    history: History
    events: np.record
    condition: Condition
    warned: np.ndarray
    has_failed: bool

    @property
    def ending(self) -> str:
        """How it ended, in one word."""
        return "complete" if self.is_complete else self.condition.name.lower()

    @property
    def is_complete(self) -> bool:
        return self.condition is Condition.RUNNING


def drive_alone(ladder: Ladder, level: float, setup: Setup) -> Outcome:
    """A run without a controller, its commands held as a node holds them."""
    manoeuvre = ladder.manoeuvre(setup, level)
    simulation = ladder.simulation(setup)
    driver, duration = manoeuvre.driver(), manoeuvre.duration
    return _outcome(ladder, manoeuvre, simulation, NOBODY_WARNS, driver, duration, setup.period)


def drive_again(
    ladder: Ladder,
    level: float,
    setup: Setup,
    driven: Driven,
    simulation: Simulation | None = None,
    observer: Observer | None = None,
) -> Outcome:
    """A run with a controller, repeated from its commands, to the bit.

    simulation: to drive, by default a new one. observer: as for `run`.
    """
    manoeuvre = ladder.manoeuvre(setup, level)
    simulation = simulation or ladder.simulation(setup)
    driver, duration = GivenCommands(driven.commands), len(driven.commands) * setup.period
    parts = (ladder, manoeuvre, simulation, driven.warned)
    return _outcome(*parts, driver, duration, setup.period, observer)


def _outcome(
    ladder: Ladder,
    manoeuvre: Manoeuvre,
    simulation: Simulation,
    warned: np.ndarray,
    driver: Programme | Feedback,
    duration: float,
    period: float,
    observer: Observer | None = None,
) -> Outcome:
    """Drive for a duration (s), with commands and samples every period (s)."""
    simulation.reset(manoeuvre.speed)
    history = run(
        simulation, driver, duration, sample=period, command_period=period, observer=observer
    )
    failed = ladder.of_test.has_failed(manoeuvre, history, simulation.condition)
    events = simulation.events.copy()
    return Outcome(manoeuvre, history, events, simulation.condition, warned, failed)
