"""Commands from a CSV file with a column `time` and any of the command columns.

Values are interpolated linearly; two rows with the same time are a step.
"""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.files.table_file import read_table
from vehicle_roll_sim.input_errors import InputError, number_in, unknown_name
from vehicle_roll_sim.manoeuvres.base import LONGEST, OpenLoop
from vehicle_roll_sim.manoeuvres.command_columns import COLUMNS, TOTALS, check_limits
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.roads.commanded import NOT_COMMANDED
from vehicle_roll_sim.simulation.command import OF_ROAD
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.air_parameters import NO_WIND, has_air_forces
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.plausibility import LARGEST_STEERING, doubtful_steering, warn

LARGEST_FILE = 200_000_000
"""Bytes: an hour at 1 kHz with every column."""
EXAMPLE = """\
time,steering,brake_torque_lf,brake_torque_rf
0.0,0.0,0,0
1.0,0.0,0,0
1.1,0.05,0,0
3.0,0.05,0,0
3.0,0.05,300,300
4.0,0.05,300,300
5.0,0.0,0,0
"""
"""Template of a command file: a steering ramp of 0.1 s, and a step of the brake torques."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class CommandTable(OpenLoop):
    """Commands at given times: interpolated linearly between rows, constant outside them.

    times: (n,) (s), non-decreasing; where two are equal, the commands step from the values of the
    first row to those of the second. columns: arrays (n,) by column name (SI, rad). file: name
    used in warnings. shares: by column of TOTALS the share of each wheel, shape (4,); `for_vehicle`
    sets it.
    """

    times: np.ndarray
    columns: dict[str, np.ndarray]
    file: str = ""
    shares: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)

    @property
    def needs_vehicle(self) -> bool:
        has_more = bool(self.columns.keys() & TOTALS.keys() or self._of("wind"))
        return super().needs_vehicle or has_more

    def _of(self, *fields: str) -> list[str]:
        """The columns with values of some fields of COMMAND."""
        return [name for name in self.columns if COLUMNS.get(name, ("",))[0] in fields]

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "CommandTable":
        """A copy that distributes total torques as the vehicle does.

        Raises InputError for columns of a wind that the vehicle does not feel.
        """
        if (windy := self._of("wind")) and not has_air_forces(vehicle):
            raise InputError(f"{self.file}: column", windy[0], NO_WIND)
        shares = {"drive_torque": vehicle.drive_shares, "brake": vehicle.brake_shares}
        return dataclasses.replace(super().for_vehicle(vehicle, options), shares=shares)

    def check_road(self, road: Road) -> None:
        if (moving := self._of(*OF_ROAD)) and not road.is_commanded:
            raise InputError(f"{self.file}: column", moving[0], NOT_COMMANDED)

    def to_whole_steps(self, step_ns: int) -> "CommandTable":
        """A copy whose duration is rounded up to a multiple of the integration step (ns).

        Raises InputError if it is 0.
        """
        if not self.duration > 0.0:
            raise InputError("duration", None, "required for commands that end at time 0")
        steps = math.ceil(self.duration * NANOSECONDS / step_ns - 1e-6)
        return dataclasses.replace(self, duration=steps * step_ns / NANOSECONDS)

    @property
    def doubts(self) -> list[str]:
        """One line for each steering column with an implausibly large angle."""
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
        fields = (TOTALS.get(name) or COLUMNS[name][0] for name in self.columns)
        return (*super().commanded, *(field.removesuffix("_change") for field in fields))

    @property
    def steps_at(self) -> tuple[float, ...]:
        return tuple(self.times[1:][np.diff(self.times) == 0.0].tolist())

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        """Set `commands` (n,) at `times` (n,) (s).

        At the time of a step the second row applies, except at the last of several `times`: they
        are the stages of integration steps, of which the last one ends just before the step.
        """
        first = int(np.searchsorted(self.times, times[-1]))
        ends_on_row = len(times) > 1 and first < len(self.times) and self.times[first] == times[-1]
        for name, values in self.columns.items():
            column = np.interp(times, self.times, values)
            if ends_on_row:
                column[-1] = values[first]
            if name in TOTALS:
                commands[TOTALS[name]] = np.outer(column, self.shares[name])
                continue
            field, index = COLUMNS[name]
            if index is None:
                commands[field] = column
            else:
                commands[field][:, index] = column - OF_ROAD.get(field, 0.0)


def load_commands(path: str | Path) -> CommandTable:
    """Read a command file; its last time is the duration. Raises InputError naming line and column.

    Issues a PlausibilityWarning for implausibly large steering angles, such as angles in degrees.
    """
    path = Path(path)
    header, lines = read_table(path, LARGEST_FILE)
    _check_header(f"{path}: line 1", header)
    rows = list(lines)
    if not rows:
        raise InputError(f"command file {path}", "", "a header and at least one row", "no rows")
    values = [
        [_number(path, line, *each) for each in zip(header, row, strict=True)] for line, row in rows
    ]
    table = dict(zip(header, np.array(values).T, strict=True))
    return _table(table, str(path), [f"{path}: line {line}: time" for line, _ in rows])


def command_table(columns: Mapping[str, Sequence[float]]) -> CommandTable:
    """Commands from arrays (n,) by the names of the columns of a command file.

    Raises InputError naming the column.
    """
    names = list(columns)
    _check_header("commands", names)
    table = {name: _column(f"commands: {name}", columns[name]) for name in names}
    for name, values in table.items():
        if len(values) != len(table["time"]):
            counts = f"{len(values)} values", f"{len(table['time'])} values, one for each time"
            raise InputError(f"commands: {name}", *counts)
        for value in (values.min(), values.max()):
            check_limits(f"commands: {name}", name, float(value))
    return _table(table, "commands", ["commands: time"] * len(table["time"]))


def _column(field: str, values: Sequence[float]) -> np.ndarray:
    try:
        column = np.array(values, float)
    except (TypeError, ValueError):
        column = np.array(math.nan)
    if column.ndim != 1 or not len(column) or not np.isfinite(column).all():
        raise InputError(field, values, "finite numbers, one for each time")
    return column


def _table(columns: dict[str, np.ndarray], file: str, where: list[str]) -> CommandTable:
    """Build a table from finite columns that include `time`.

    where: the field name for the time of each row, for error messages. file: name for warnings.
    """
    times = _with_exact_steps(columns.pop("time"))
    latest = []
    for place, time in zip(where, times.tolist(), strict=True):
        latest = [*latest[-2:], time]
        _check_time(place, latest)
    if not abs(times[-1]) <= LONGEST:
        raise InputError(where[-1], float(times[-1]), f"at most {LONGEST:g} s")
    commands = CommandTable(times=times, columns=columns, file=file, duration=float(times[-1]))
    warn(commands.doubts)
    return commands


def _with_exact_steps(times: np.ndarray) -> np.ndarray:
    """Times (s), with those of steps rounded to whole nanoseconds like simulated time."""
    is_same = np.diff(times) == 0.0
    is_step = np.append(is_same, False) | np.append(False, is_same)
    return np.where(is_step, np.round(times * NANOSECONDS) / NANOSECONDS, times)


def _check_time(where: str, latest: list[float]) -> None:
    """Raise InputError if the last of up to three times is less than the one before, or if all
    three are equal."""
    *before, time = latest
    if before and time < before[-1]:
        raise InputError(where, time, f"at least {before[-1]:g}, the time of the previous row")
    if before == [time, time]:
        raise InputError(where, time, "at most two rows with the same time, which are a step")


def _check_header(where: str, header: list[str]) -> None:
    for name in header:
        if name not in COLUMNS and name not in TOTALS and name != "time":
            raise unknown_name(str(name), ("time", *COLUMNS, *TOTALS), f"{where}: column")
        if header.count(name) > 1:
            raise InputError(f"{where}: column", name, "each column once")
    for total, field in TOTALS.items():
        others = [name for name in header if name.startswith(f"{field}_")]
        if total in header and others:
            problem = f"{total} together with {others[0]}"
            raise InputError(f"{where}: column", total, "a total, or values of wheels", problem)
    if "time" not in header:
        raise InputError(where, ",".join(header), "column names that include `time`")


def _number(path: Path, line: int, name: str, text: str) -> float:
    field = f"{path}: line {line}: {name}"
    try:
        value = number_in(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(field, text, "a finite number, with a decimal point")
    check_limits(field, name, value)
    return value
