"""Conversion of the argument of `run` to a Manoeuvre: a name, a file, a table or a driver."""

import dataclasses
import os
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, unknown_name, validated
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.catalogue import MANOEUVRES
from vehicle_roll_sim.manoeuvres.command_file import CommandTable, command_table, load_commands
from vehicle_roll_sim.simulation.command import Command, Feedback, Programme

FIELD = "manoeuvre"
ALLOWED = (
    "a name, a Manoeuvre, a command file (.csv) or table, a Command, a function of time or "
    "a Feedback"
)
COMMANDED = (
    *("steering", "rear_steering", "wheel_torque", "brake_torque", "normal_force", "wind"),
    *("road_height", "road_friction"),
)
"""The commands that a user-defined driver may issue."""


@dataclasses.dataclass(frozen=True)
class Held:
    """A Programme with a constant command."""

    command: Command

    def __call__(self, times: np.ndarray) -> np.ndarray:
        """An array of one COMMAND record, shape (1,), whatever the times."""
        return self.command.records()


@dataclasses.dataclass(frozen=True, kw_only=True)
class Driven(Manoeuvre):
    """A user-defined driver as a manoeuvre, with an entry speed and a duration."""

    driven_by: Programme | Feedback

    @property
    def commanded(self) -> tuple[str, ...]:
        return COMMANDED

    def driver(self) -> Programme | Feedback:
        return self.driven_by


def manoeuvre_of(asked, values: Mapping, step_ns: int) -> Manoeuvre:
    """Convert `asked` to a manoeuvre, with some of its values replaced, in their declared units.

    asked: see ALLOWED. step_ns: integration step (ns); the duration of a command table is rounded
    up to a multiple of it. Raises InputError for anything else, and for invalid values by name.
    """
    if isinstance(asked, Command):
        asked = Held(asked)
    is_driver = callable(asked) and not isinstance(asked, Manoeuvre | type)
    if is_driver or isinstance(asked, Feedback):
        if "duration" not in values:
            raise InputError("duration", None, "the duration of the run (s)")
        return Driven(driven_by=asked, **validated(Driven, values))
    manoeuvre = _named(asked)
    values = validated(type(manoeuvre), values)
    if isinstance(manoeuvre, CommandTable) and "duration" not in values:
        manoeuvre = manoeuvre.to_whole_steps(step_ns)
    return manoeuvre.with_values(values)


def _named(asked) -> Manoeuvre:
    if isinstance(asked, Manoeuvre):
        return asked
    if isinstance(asked, str) and Path(asked).suffix.lower() != ".csv":
        if asked not in MANOEUVRES:
            raise unknown_name(asked, MANOEUVRES, FIELD)
        return MANOEUVRES[asked]
    if isinstance(asked, str | os.PathLike):
        return load_commands(asked)
    if hasattr(asked, "columns"):  # a DataFrame
        asked = {name: asked[name] for name in asked.columns}
    if isinstance(asked, Mapping):
        return command_table(asked)
    raise InputError(FIELD, asked, ALLOWED)
