"""Map files: which column of a log is which quantity, in which unit and with which sign."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path

from vehicle_roll_sim.files.yaml_file import Place, read_mapping
from vehicle_roll_sim.input_errors import InputError, number_of, plain, unknown_name
from vehicle_roll_sim.logs.quantities import ACCELERATION, BODY, FRAMES, PLACED, QUANTITIES

WANTED = "a YAML mapping with columns, see docs/logs.md"
ISO, SAE = AXES = ("iso", "sae")
"""Axes of a log: x forward, y left, z up (ISO 8855); or x forward, y right, z down (SAE J670)."""
KEYS = ("axes", "separator", "decimal", "header_line", "first_line", "columns")
COLUMN_KEYS = ("column", "unit", "sign", "place", "frame")
SEPARATORS = (",", ";", "\t", "|", " ")
DECIMALS = (".", ",")
LAST_LINE = 1000
"""Headers end before it."""
FARTHEST = 20.0
"""m: of a sensor from the c.g., in each direction."""
AT_CG = (0.0, 0.0, 0.0)


@dataclasses.dataclass(frozen=True)
class Column:
    """One column of a log.

    name: in the log. unit: None for that which the log states itself. sign: 1 or -1. place: of the
    sensor (m): forward, left and up from the c.g. of the sprung mass. frame: of an acceleration.
    field: how messages name it.
    """

    name: str
    unit: str | None
    sign: float
    place: tuple[float, float, float]
    frame: str
    field: str


@dataclasses.dataclass(frozen=True)
class LogMap:
    """What a map file says. columns: by quantity. separator, decimal: None if to be found.

    header_line, first_line: of the names and of the first row in a CSV file, counted from 1.
    """

    columns: Mapping[str, Column]
    axes: str
    separator: str | None
    decimal: str | None
    header_line: int
    first_line: int

    def sign(self, quantity: str) -> float:
        """1 or -1: turns values of the log into those along the axes of ISO 8855."""
        is_turned = self.axes == SAE and QUANTITIES[quantity].flips
        return -self.columns[quantity].sign if is_turned else self.columns[quantity].sign


def map_of(given: str | Path | Mapping) -> LogMap:
    """A map from a file or from a mapping of the same keys; raises InputError naming the place."""
    if isinstance(given, Mapping):
        return _Reader("map", given, {}).log_map()
    return _Reader(str(given), *read_mapping(Path(given), "map file", WANTED)).log_map()


@dataclasses.dataclass(frozen=True)
class _Reader:
    """Reads the values of a map. lines: line of each place in the file."""

    source: str
    values: Mapping
    lines: Mapping[Place, int]

    def log_map(self) -> LogMap:
        self._check_names((), self.values, KEYS)
        columns = self.values.get("columns")
        if not isinstance(columns, Mapping) or not columns:
            allowed = "NAME: {column: …, unit: …} lines"
            raise InputError(self._where("columns"), columns, allowed)
        self._check_names(("columns",), columns, QUANTITIES)
        found = {name: self._column(name, values) for name, values in columns.items()}
        header = self._line("header_line", 1, 1)
        return LogMap(
            found,
            self._choice(("axes",), self.values.get("axes", ISO), AXES),
            self._choice(("separator",), self.values.get("separator"), (*SEPARATORS, None)),
            self._choice(("decimal",), self.values.get("decimal"), (*DECIMALS, None)),
            header,
            self._line("first_line", header + 1, header + 1),
        )

    def _column(self, quantity: str, values) -> Column:
        place = ("columns", quantity)
        if not isinstance(values, Mapping):
            raise InputError(self._where(*place), values, "{column: NAME, unit: UNIT}")
        self._check_names(place, values, COLUMN_KEYS)
        name = values.get("column")
        if not isinstance(name, str) or not name:
            raise InputError(self._where(*place, "column"), name, "the name of a column, as text")
        unit = values.get("unit")
        if unit is not None and not isinstance(unit, str):
            raise InputError(self._where(*place, "unit"), unit, "a unit as text, such as deg/s")
        sign = plain(values.get("sign", 1))
        if isinstance(sign, bool) or sign not in (1, -1):
            raise InputError(self._where(*place, "sign"), sign, "1 or -1")
        if "frame" in values and quantity != ACCELERATION:
            allowed = f"only {ACCELERATION} has a frame"
            raise InputError(self._where(*place, "frame"), values["frame"], allowed)
        frame = self._choice((*place, "frame"), values.get("frame", BODY), FRAMES)
        return Column(
            name, unit, float(sign), self._place(quantity, values), frame, self._where(*place)
        )

    def _place(self, quantity: str, values: Mapping) -> tuple[float, float, float]:
        given = values.get("place", AT_CG)
        where = self._where("columns", quantity, "place")
        if "place" in values and quantity not in PLACED:
            raise InputError(where, given, f"only {' and '.join(PLACED)} depend on a place")
        allowed = f"[forward, left, up] of the c.g. in m, from {-FARTHEST:g} to {FARTHEST:g}"
        if not isinstance(given, list | tuple) or len(given) != 3:
            raise InputError(where, given, allowed)
        numbers = tuple(number_of(each, where, allowed) for each in given)
        if not all(abs(each) <= FARTHEST for each in numbers):
            raise InputError(where, given, allowed)
        return numbers

    def _line(self, key: str, default: int, lowest: int) -> int:
        value = plain(self.values.get(key, default))
        if isinstance(value, bool) or not isinstance(value, int) or not lowest <= value < LAST_LINE:
            allowed = f"a whole number from {lowest} to {LAST_LINE - 1}"
            raise InputError(self._where(key), value, allowed)
        return value

    def _choice(self, place: Place, value, choices: tuple):
        if not isinstance(value, str | None) or value not in choices:
            allowed = "one of " + ", ".join(repr(each) for each in choices if each)
            raise InputError(self._where(*place), value, allowed)
        return value

    def _check_names(self, place: Place, values: Mapping, known) -> None:
        for name in values:
            if name not in known:
                raise unknown_name(str(name), known, self._where(*place, str(name)))

    def _where(self, *place: str) -> str:
        line = self.lines.get(place)
        names = ": ".join(place)
        return f"{self.source}: line {line}: {names}" if line else f"{self.source}: {names}"
