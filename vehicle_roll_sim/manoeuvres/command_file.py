"""Commands from a CSV file: a column `time` and any of the command columns, linear in between."""

import csv
import dataclasses
import itertools
import math
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, unknown_name
from vehicle_roll_sim.manoeuvres.manoeuvre import Manoeuvre
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.vehicle.text_file import read_text

LARGEST_FILE = 200_000_000
"""Bytes: an hour at 1 kHz with every column."""
COLUMNS = {
    **{name: (name, None) for name in ("steering", "rear_steering")},
    **{
        f"{name}_{wheel}": (name, i)
        for name in ("wheel_torque", "normal_force")
        for i, wheel in enumerate(WHEELS)
    },
}
"""Column name: field of the command, and wheel for a field of four."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class CommandTable(Manoeuvre):
    """Commands at given times (s, rising): linear between rows, held outside them."""

    times: np.ndarray
    columns: dict[str, np.ndarray]

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        for name, values in self.columns.items():
            field, wheel = COLUMNS[name]
            column = commands[field] if wheel is None else commands[field][:, wheel]
            column[:] = np.interp(times, self.times, values)


def load_commands(path: str | Path) -> CommandTable:
    """Read a command file, as long as its last time; raises InputError naming line and column."""
    path = Path(path)
    rows = csv.reader(read_text(path, LARGEST_FILE).splitlines())
    header = [name.strip() for name in next(rows, [])]
    _check_header(path, header)
    values = [_numbers(path, line, header, row) for line, row in enumerate(rows, 2) if row]
    if not values:
        raise InputError(f"command file {path}", "no rows", "a header and at least one row")
    table = dict(zip(header, np.array(values).T, strict=True))
    times = table.pop("time")
    for line, (before, after) in enumerate(itertools.pairwise(times), 3):
        if after <= before:
            raise InputError(f"{path}: line {line}: time", after, f"more than {before:g}")
    return CommandTable(times=times, columns=table, duration=float(times[-1]))


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
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{path}: line {line}: {name}", text, "a finite number")
    return value
