"""Whatever a run is asked to drive, as a manoeuvre: by name, from a file or table, or a driver."""

import dataclasses
import math
import os
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, unknown_name, validated
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.manoeuvres.command_file import CommandTable, command_table, load_commands
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.simulation.command import Command, Feedback, Programme

FIELD = "manoeuvre"
ALLOWED = (
    "a name, a Manoeuvre, a command file (.csv) or table, a Command, a function of time or "
    "a Feedback"
)
COMMANDED = ("steering", "rear_steering", "wheel_torque", "brake_torque", "normal_force")
"""What a driver of the user's own may command."""


@dataclasses.dataclass(frozen=True)
class Held:
    """A Programme whose command never changes."""

    command: Command

    def __call__(self, times: np.ndarray) -> np.ndarray:
        """The one COMMAND record, in an array."""
        return self.command.records()


@dataclasses.dataclass(frozen=True, kw_only=True)
class Driven(Manoeuvre):
    """A driver of the user's own, with the speed and the length of its run."""

    driven_by: Programme | Feedback

    @property
    def commanded(self) -> tuple[str, ...]:
        return COMMANDED

    def driver(self) -> Programme | Feedback:
        return self.driven_by


def manoeuvre_of(asked, values: Mapping, step_ns: int) -> Manoeuvre:
    """The manoeuvre that is asked for, with some of its values replaced, in their declared units.

    asked: what ALLOWED says. step_ns: integration step (ns), of which the length of a command
    table is made a multiple. Raises InputError for anything else, and by name for the values.
    """
    if isinstance(asked, Command):
        asked = Held(asked)
    is_driver = callable(asked) and not isinstance(asked, Manoeuvre | type)
    if is_driver or isinstance(asked, Feedback):
        if "duration" not in values:
            raise InputError("duration", None, "how long to drive (s)")
        return Driven(driven_by=asked, **validated(Driven, values))
    manoeuvre = _named(asked)
    values = validated(type(manoeuvre), values)
    if isinstance(manoeuvre, CommandTable) and "duration" not in values:
        if not manoeuvre.duration > 0.0:
            raise InputError("duration", None, "a file that ends at time 0 does not say how long")
        steps = math.ceil(manoeuvre.duration * NANOSECONDS / step_ns - 1e-6)
        values["duration"] = steps * step_ns / NANOSECONDS
    return dataclasses.replace(manoeuvre, **values)


def _named(asked) -> Manoeuvre:
    if isinstance(asked, Manoeuvre):
        return asked
    if isinstance(asked, str) and Path(asked).suffix.lower() != ".csv":
        if asked not in STANDARD:
            raise unknown_name(asked, STANDARD, FIELD)
        return STANDARD[asked]
    if isinstance(asked, str | os.PathLike):
        return load_commands(asked)
    if hasattr(asked, "columns"):  # a DataFrame
        asked = {name: asked[name] for name in asked.columns}
    if isinstance(asked, Mapping):
        return command_table(asked)
    raise InputError(FIELD, asked, ALLOWED)
