"""Commands from a CSV file: a column `time` and any of the command columns, linear in between."""

import csv
import dataclasses
import itertools
import math
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, number_in, unknown_name
from vehicle_roll_sim.manoeuvres.base import LONGEST, OpenLoop
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.vehicle.plausibility import LARGEST_STEERING, doubtful_steering, warn
from vehicle_roll_sim.vehicle.text_file import read_text

LARGEST_FILE = 200_000_000
"""Bytes: an hour at 1 kHz with every column."""
COLUMNS = {
    **{name: (name, None) for name in ("steering", "rear_steering")},
    **{
        f"{name}_{wheel}": (name, i)
        for name in ("wheel_torque", "brake_torque", "normal_force")
        for i, wheel in enumerate(WHEELS)
    },
}
"""Column name: field of the command, and wheel for a field of four."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class CommandTable(OpenLoop):
    """Commands at given times (s, rising): linear between rows, held outside them."""

    times: np.ndarray
    columns: dict[str, np.ndarray]
    file: str = ""

    @property
    def doubts(self) -> list[str]:
        """Of the steering: a line for each of its columns that goes further than wheels do."""
        lines = []
        for name in self.columns.keys() & {"steering", "rear_steering"}:
            row = int(np.argmax(np.abs(self.columns[name])))
            angle = float(self.columns[name][row])
            if abs(angle) > LARGEST_STEERING:
                where = f"{self.file}: {name} at {self.times[row]:g} s"
                lines.append(doubtful_steering(where, angle))
        return sorted(lines)

    @property
    def commanded(self) -> tuple[str, ...]:
        return (*super().commanded, *(COLUMNS[name][0] for name in self.columns))

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        for name, values in self.columns.items():
            field, wheel = COLUMNS[name]
            column = commands[field] if wheel is None else commands[field][:, wheel]
            column[:] = np.interp(times, self.times, values)


def load_commands(path: str | Path) -> CommandTable:
    """Read a command file, as long as its last time; raises InputError naming line and column.

    Warns (PlausibilityWarning) of steering beyond what wheels do, as in degrees.
    """
    path = Path(path)
    reader = csv.reader(read_text(path, LARGEST_FILE).splitlines())
    try:
        header = [name.strip() for name in next(reader, [])]
        _check_header(path, header)
        rows = [(reader.line_num, row) for row in reader if row]
    except csv.Error as error:
        where = f"{path}: line {reader.line_num}"
        raise InputError(where, "", "comma-separated values are wanted", str(error)) from None
    if not rows:
        raise InputError(f"command file {path}", "", "a header and at least one row", "no rows")
    values = [_numbers(path, line, header, row) for line, row in rows]
    table = dict(zip(header, np.array(values).T, strict=True))
    times = table.pop("time")
    for (before, after), (line, _) in zip(itertools.pairwise(times), rows[1:], strict=True):
        if after <= before:
            raise InputError(f"{path}: line {line}: time", float(after), f"more than {before:g}")
    if not abs(times[-1]) <= LONGEST:
        where = f"{path}: line {rows[-1][0]}: time"
        raise InputError(where, float(times[-1]), f"at most {LONGEST:g} s")
    commands = CommandTable(times=times, columns=table, file=str(path), duration=float(times[-1]))
    warn(commands.doubts)
    return commands


def _check_header(path: Path, header: list[str]) -> None:
    if "time" not in header:
        raise InputError(f"{path}: line 1", ",".join(header), "column names, `time` among them")
    for name in header:
        if name not in COLUMNS and name != "time":
            raise unknown_name(name, ("time", *COLUMNS), f"{path}: line 1: column")
        if header.count(name) > 1:
            raise InputError(f"{path}: line 1: column", name, "each column once")


def _numbers(path: Path, line: int, header: list[str], row: list[str]) -> list[float]:
    if len(row) != len(header):
        raise InputError(f"{path}: line {line}", f"{len(row)} values", f"{len(header)} values")
    return [_number(path, line, name, text) for name, text in zip(header, row, strict=True)]


def _number(path: Path, line: int, name: str, text: str) -> float:
    try:
        value = number_in(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{path}: line {line}: {name}", text, "a finite number")
    if value < 0.0 and name.startswith("brake_torque"):
        raise InputError(f"{path}: line {line}: {name}", text, "a number that is not below 0")
    return value
