"""What a run was: one row of named signals for each sample, in memory and as CSV."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, number_in
from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.files.table_file import read_table
from vehicle_roll_sim.model.records import MODEL_STATE_SIZE, STATE_NAMES, WHEELS
from vehicle_roll_sim.simulation.signals import OUTPUT_SIGNALS, STATE_SIGNALS, field_of
from vehicle_roll_sim.simulation.simulation import Simulation

LARGEST_FILE = 500_000_000
"""Bytes: an hour with a row every 10 ms takes 360 million."""
MISSING_SHOWN = 3
"""Missing columns that a refusal names."""

OUTPUT_QUANTITIES = (
    "normal_force",
    "longitudinal_force",
    "lateral_force",
    "slip_ratio",
    "slip_angle",
)
ACCELERATIONS = ("longitudinal_acceleration", "lateral_acceleration")
_ACCELERATIONS = dict.fromkeys(ACCELERATIONS, OUTPUT_SIGNALS["acceleration"])
COLUMNS = (
    "time",
    *STATE_NAMES[:MODEL_STATE_SIZE],
    *(f"{quantity}_{wheel}" for quantity in OUTPUT_QUANTITIES for wheel in WHEELS),
    "steering",
    *ACCELERATIONS,
)
"""Names of the columns; SI units and radians, forces and accelerations in frame 2."""
UNITS = {
    name: "s"
    if name == "time"
    else (STATE_SIGNALS | OUTPUT_SIGNALS | _ACCELERATIONS)[field_of(name)].unit
    for name in COLUMNS
}
"""Of each column, '' for a ratio."""
COMMANDS = (
    "rear_steering",
    *(f"{command}_{wheel}" for command in ("wheel_torque", "brake_torque") for wheel in WHEELS),
    *(f"active_force_{wheel}" for wheel in WHEELS),
)
"""Names of the commands beside the steering: what the period that ends with a row was driven with,
or, where commands vary within periods, those at its time."""
WITH_COMMANDS = "in the CSV also every command beside the steering, which `plot` then draws"
"""What the option of that name does."""


def check_with_commands(wanted: bool, csv: Path | None) -> None:
    """Raise InputError where commands are wanted in a file that is not."""
    if wanted and csv is None:
        raise InputError("--with-commands", "", "together with --csv", "without a file")


def row_of(simulation: Simulation) -> np.ndarray:
    """The columns at the present simulated time."""
    outputs = simulation.outputs
    return np.concatenate(
        (
            [simulation.time],
            simulation.state_vector[:MODEL_STATE_SIZE],
            *(outputs[quantity] for quantity in OUTPUT_QUANTITIES),
            outputs["steering"][:1],
            outputs["acceleration"][: len(ACCELERATIONS)],
        )
    )


class History:
    """Rows of `COLUMNS`; history["roll"] is a column, history.wheels("normal_force") four.

    commands: rows of `COMMANDS`, where they are known, or None; nan then.
    """

    def __init__(self, rows: list[np.ndarray] | np.ndarray, commands: np.ndarray | None = None):
        self.rows, self.commands = np.array(rows), commands

    @classmethod
    def read_csv(cls, path: Path) -> "History":
        """The rows of a file of `write_csv`; raises InputError naming line and column.

        Columns may stand in any order, and others beside them. All but the time may be nan. A time
        may come twice, as the last one of a run that diverged does, but none may fall. Those of
        `COMMANDS` are read where all are there.
        """
        header, lines = read_table(path, LARGEST_FILE)
        has_commands = set(COMMANDS) <= set(header)
        places = _places(path, header, (*COLUMNS, *COMMANDS) if has_commands else COLUMNS)
        rows, time = [], -math.inf
        for line, texts in lines:
            row = [_number(path, line, header[place], texts[place]) for place in places]
            if not (time <= row[0] and math.isfinite(row[0])):
                wanted = f"a finite number, at least {time!r}" if rows else "a finite number"
                raise InputError(f"{path}: line {line}: {COLUMNS[0]}", row[0], wanted)
            rows.append(np.array(row))
            time = row[0]
        if not rows:
            raise InputError(f"file {path}", "", "a header and at least one row", "no rows")
        rows = np.array(rows)
        of_states = len(COLUMNS)
        return cls(rows[:, :of_states], rows[:, of_states:] if has_commands else None)

    def __getitem__(self, name: str) -> np.ndarray:
        return self.rows[:, COLUMNS.index(name)]

    def wheels(self, quantity: str) -> np.ndarray:
        """A quantity of all wheels, shape (rows, 4)."""
        first = COLUMNS.index(f"{quantity}_{WHEELS[0]}")
        return self.rows[:, first : first + len(WHEELS)]

    def command(self, name: str) -> np.ndarray:
        """One of `COMMANDS`, or those of all wheels without a wheel's name, shape (rows, 4)."""
        wanted = [name] if name in COMMANDS else [f"{name}_{wheel}" for wheel in WHEELS]
        if self.commands is None:
            found = np.full((len(self.rows), len(wanted)), np.nan)
        else:
            found = self.commands[:, [COMMANDS.index(each) for each in wanted]]
        return found[:, 0] if name in COMMANDS else found

    def part(self, chosen: np.ndarray) -> "History":
        """The rows that are chosen: a boolean for each."""
        commands = None if self.commands is None else self.commands[chosen]
        return History(self.rows[chosen], commands)

    def write_csv(self, path: str | Path, with_commands: bool = False) -> None:
        """Write all rows in full precision; the file appears whole or not at all.

        with_commands: with `COMMANDS` behind the other columns, nan where they are not known.
        """
        names, rows = COLUMNS, self.rows
        if with_commands:
            names, rows = (*COLUMNS, *COMMANDS), np.hstack((rows, self._known_commands()))
        with replaced_file(path) as partial, partial.open("w", encoding="utf-8") as file:
            file.write(",".join(names) + "\n")
            for row in rows.tolist():
                file.write(",".join(map(repr, row)) + "\n")

    def _known_commands(self) -> np.ndarray:
        unknown = np.full((len(self.rows), len(COMMANDS)), np.nan)
        return unknown if self.commands is None else self.commands


def _places(path: Path, header: list[str], columns: Sequence[str]) -> list[int]:
    """Where each of the columns stands in a line."""
    missing = [name for name in COLUMNS if name not in header]
    if missing:
        more = len(missing) - MISSING_SHOWN
        names = ", ".join(missing[:MISSING_SHOWN]) + (f" and {more} more" if more > 0 else "")
        wanted = "the columns of a file of `run --csv`"
        raise InputError(f"{path}: line 1", "", wanted, f"without {names}")
    for name in columns:
        if header.count(name) > 1:
            raise InputError(f"{path}: line 1: column", name, "each column once")
    return [header.index(name) for name in columns]


def _number(path: Path, line: int, name: str, text: str) -> float:
    try:
        return number_in(text)
    except ValueError:
        raise InputError(f"{path}: line {line}: {name}", text, "a number") from None
