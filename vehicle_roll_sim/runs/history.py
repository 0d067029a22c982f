"""The history of a run: one row of named signals per sample, in memory and as CSV."""

import itertools
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.files.table_file import read_table
from vehicle_roll_sim.input_errors import InputError, number_in
from vehicle_roll_sim.model.records import AXLE_COUNT, WHEELS
from vehicle_roll_sim.runs.columns import (
    BODY_LOADS,
    COLUMNS,
    COMMANDS,
    FURTHER,
    ROLL_CENTRES,
    WHEEL_LIFTS,
    WIND,
)
from vehicle_roll_sim.runs.derived_signals import SIGNALS, signals_of
from vehicle_roll_sim.runs.metrics import wheel_lift
from vehicle_roll_sim.simulation.options import Options

LARGEST_FILE = 500_000_000
"""Bytes; an hour at 10 ms per row takes 360 million."""
MISSING_SHOWN = 3
"""Maximum number of missing columns named in an error message."""

WITH_COMMANDS = "add all commands to the CSV, not only the steering; `plot` then draws them"
WITH_SIGNALS = "add sideslip angle, load transfer and the lift of each wheel to the CSV"
"""Help texts of the options of these names."""


def check_with_csv(option: str, wanted: bool, csv: Path | None) -> None:
    """Raise InputError if further columns are requested without a CSV file to write them to."""
    if wanted and csv is None:
        raise InputError(option, "", "together with --csv", "without a file")


class History:
    """Samples of a run; `history["roll"]` is one column, shape (rows,).

    rows: values of COLUMNS, shape (rows, columns); an array is kept, not copied. commands: values
    of COMMANDS, shape (rows, commands), or None if they are unknown. roll_centres: values of
    ROLL_CENTRES, shape (rows, 4), or None if the model has none or they are unknown. wind: values
    of WIND, shape (rows, 2), or None if the vehicle does not feel it or it is unknown. measured:
    the last readings of sensors, shape (rows, k), and `measured_names`, the k names of further
    columns; none without sensors. body_loads: values of BODY_LOADS, shape (rows, 8), or None.
    lifts: of the wheels on a road with features (m), shape (rows, 4); None on a plane, where the
    tire compressions have them.
    """

    def __init__(
        self,
        rows: list[np.ndarray] | np.ndarray,
        commands: np.ndarray | None = None,
        roll_centres: np.ndarray | None = None,
        wind: np.ndarray | None = None,
        measured: np.ndarray | None = None,
        measured_names: tuple[str, ...] = (),
        body_loads: np.ndarray | None = None,
        lifts: np.ndarray | None = None,
    ):
        self.lifts = lifts
        self.rows, self.commands, self.roll_centres = np.asarray(rows), commands, roll_centres
        self.wind, self.measured_names, self.body_loads = wind, measured_names, body_loads
        self.measured = np.zeros((len(self.rows), 0)) if measured is None else measured

    @classmethod
    def read_csv(cls, path: Path) -> "History":
        """Read a file written by `write_csv`; raises InputError naming line and column.

        Columns may be in any order, and further columns are ignored. Each of the groups of FURTHER
        is read if all of its columns are present. All values except the time may be nan. Times must
        not decrease; a time may occur twice, like the last one of a run that diverged.
        """
        header, lines = read_table(path, LARGEST_FILE)
        further = [names for names in FURTHER if set(names) <= set(header)]
        places = _places(path, header, tuple(itertools.chain(COLUMNS, *further)))
        rows, time = [], -math.inf
        for line, texts in lines:
            row = [_number(path, line, header[place], texts[place]) for place in places]
            if not (time <= row[0] and math.isfinite(row[0])):
                wanted = f"a finite number of at least {time!r}" if rows else "a finite number"
                raise InputError(f"{path}: line {line}: {COLUMNS[0]}", row[0], wanted)
            rows.append(np.array(row))
            time = row[0]
        if not rows:
            raise InputError(f"file {path}", "", "a header and at least one row", "no rows")
        ends = np.cumsum([len(names) for names in (COLUMNS, *further)])[:-1]
        own, *others = np.split(np.array(rows), ends, axis=1)
        found = dict(zip(further, others, strict=True))
        return cls(own, **{name: found.get(names) for names, name in FURTHER.items()})

    def __getitem__(self, name: str) -> np.ndarray:
        return self.rows[:, COLUMNS.index(name)]

    @property
    def interval(self) -> float:
        """Longest time between two samples (s); 0 for a single one."""
        return float(np.diff(self["time"]).max(initial=0.0))

    def roll_centre(self, measure: str) -> np.ndarray:
        """Height or place of the roll centre of each axle, shape (rows, 2) (m); nan if unknown."""
        if self.roll_centres is None:
            return np.full((len(self.rows), AXLE_COUNT), np.nan)
        names = [f"{axle}_roll_centre_{measure}" for axle in ("front", "rear")]
        return self.roll_centres[:, [ROLL_CENTRES.index(name) for name in names]]

    def wheels(self, quantity: str) -> np.ndarray:
        """A quantity at all wheels (lf, rf, lr, rr), shape (rows, 4)."""
        first = COLUMNS.index(f"{quantity}_{WHEELS[0]}")
        return self.rows[:, first : first + len(WHEELS)]

    def wheel_lift(self) -> np.ndarray:
        """Distance of the tires from the road, shape (rows, 4) (m), see SIGNALS; nan if unknown."""
        return wheel_lift(self.wheels("tire_compression")) if self.lifts is None else self.lifts

    def signals(self) -> np.ndarray:
        """The values of SIGNALS, shape (rows, len(SIGNALS))."""
        velocity = (self["u"], self["v"], self["w"])
        parts = (self["roll"], self["pitch"], self.wheels("normal_force"), self.wheel_lift())
        return signals_of(velocity, *parts)

    def command(self, name: str) -> np.ndarray:
        """One column of COMMANDS or WIND, shape (rows,); nan if it is unknown.

        Without the name of a wheel, such as `wheel_torque`: those of all wheels, shape (rows, 4).
        """
        if name in WIND:
            unknown = np.full(len(self.rows), np.nan)
            return unknown if self.wind is None else self.wind[:, WIND.index(name)]
        wanted = [name] if name in COMMANDS else [f"{name}_{wheel}" for wheel in WHEELS]
        if self.commands is None:
            found = np.full((len(self.rows), len(wanted)), np.nan)
        else:
            found = self.commands[:, [COMMANDS.index(each) for each in wanted]]
        return found[:, 0] if name in COMMANDS else found

    def add_further(self, values: np.ndarray, options: Options) -> None:
        """Add what a model with these options has of `further_of`, one row for each row."""
        centres, loads = np.split(values, [len(ROLL_CENTRES)], axis=1)
        self.roll_centres = centres.copy() if options.is_kinematic else None
        self.body_loads = loads.copy() if options.body_contact else None

    def part(self, chosen: np.ndarray) -> "History":
        """The selected rows; chosen: a boolean for each row, shape (rows,)."""
        found = {name: getattr(self, name) for name in FURTHER.values()}
        found = {name: None if v is None else v[chosen] for name, v in found.items()}
        measured = {"measured": self.measured[chosen], "measured_names": self.measured_names}
        return History(self.rows[chosen], **found, **measured)

    def write_csv(
        self, path: str | Path, with_commands: bool = False, with_signals: bool = False
    ) -> None:
        """Write all rows in full precision; the file is written completely or not at all.

        Columns of ROLL_CENTRES, BODY_LOADS and WHEEL_LIFTS follow if there are any; the last are
        among SIGNALS, too. with_commands: append COMMANDS, nan if they are unknown, and WIND if it
        is known. with_signals: append SIGNALS. What sensors measured comes last.
        """
        names, rows = COLUMNS, self.rows
        if self.roll_centres is not None:
            names, rows = (*names, *ROLL_CENTRES), np.hstack((rows, self.roll_centres))
        if self.body_loads is not None:
            names, rows = (*names, *BODY_LOADS), np.hstack((rows, self.body_loads))
        if self.lifts is not None and not with_signals:
            names, rows = (*names, *WHEEL_LIFTS), np.hstack((rows, self.lifts))
        if with_commands:
            names, rows = (*names, *COMMANDS), np.hstack((rows, self._known_commands()))
            if self.wind is not None:
                names, rows = (*names, *WIND), np.hstack((rows, self.wind))
        if with_signals:
            names, rows = (*names, *SIGNALS), np.hstack((rows, self.signals()))
        if self.measured_names:
            names, rows = (*names, *self.measured_names), np.hstack((rows, self.measured))
        with replaced_file(path) as partial, partial.open("w", encoding="utf-8") as file:
            file.write(",".join(names) + "\n")
            for row in rows.tolist():
                file.write(",".join(map(repr, row)) + "\n")

    def _known_commands(self) -> np.ndarray:
        unknown = np.full((len(self.rows), len(COMMANDS)), np.nan)
        return unknown if self.commands is None else self.commands


def _places(path: Path, header: list[str], columns: Sequence[str]) -> list[int]:
    """The index of each of the columns in a line of the file; raises InputError."""
    missing = [name for name in COLUMNS if name not in header]
    if missing:
        more = len(missing) - MISSING_SHOWN
        names = ", ".join(missing[:MISSING_SHOWN]) + (f" and {more} more" if more > 0 else "")
        wanted = "all columns that `run --csv` writes"
        raise InputError(f"{path}: line 1", "", wanted, f"{names} missing")
    for name in columns:
        if header.count(name) > 1:
            raise InputError(f"{path}: line 1: column", name, "each column once")
    return [header.index(name) for name in columns]


def _number(path: Path, line: int, name: str, text: str) -> float:
    try:
        return number_in(text)
    except ValueError:
        raise InputError(f"{path}: line {line}: {name}", text, "a number") from None
