"""Reader of tire property files (.tir): sections, `$` and `!` comments, units."""

import dataclasses
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.declaration import InputError, number_in, number_of, unknown_name
from vehicle_roll_sim.files.text_file import read_text
from vehicle_roll_sim.model.tire.coefficients import OPTIONAL, RANGES, REQUIRED, SCALING, TIRE
from vehicle_roll_sim.vehicle.tire_record import MIRRORED, tire_record

FORMAT = "PROPERTY_FILE_FORMAT"
FORMATS = ("MF_05", "PAC2002", "MF-TYRE")
FITTYPES = ("5", "6", "51", "52")
"""Values of the FITTYP key of MF-TYRE files that stand for Magic Formula 5.0 to 5.2."""

UNITS = {
    "LENGTH": {"meter": 1.0, "m": 1.0, "mm": 1e-3, "millimeter": 1e-3, "inch": 0.0254},
    "FORCE": {"newton": 1.0, "n": 1.0, "knewton": 1e3, "kn": 1e3, "pound_force": 4.4482216152605},
    "ANGLE": {"radians": 1.0, "radian": 1.0, "rad": 1.0},
    "MASS": {"kg": 1.0, "kilogram": 1.0},
    "TIME": {"second": 1.0, "sec": 1.0, "s": 1.0},
}
"""Supported units and their values in SI units.

Angles must be in radians: no standard defines coefficients per degree.
"""

HEADER = re.compile(r"\s*\[(?P<name>[^\]]+)\]\s*([$!].*)?$")
ENTRY = re.compile(r"\s*(?P<key>\w+)\s*=\s*(?P<value>'[^']*'|\"[^\"]*\"|[^$!]*)")
IGNORED = re.compile(r"\s*([$!].*|\{.*|[-+.\d][-+.\deE\s]*([$!].*)?)?$")
"""Empty lines, comments, and the headings and rows of tables such as [SHAPE]."""

IN_FORCE_UNITS = ("FNOMIN", "FZMIN", "FZMAX")
UNBOUNDED = {name: -math.inf if name.endswith("MIN") else math.inf for name in RANGES}
DEFAULTS = dict.fromkeys(SCALING, 1.0) | dict.fromkeys(OPTIONAL, 0.0) | UNBOUNDED
USED = {*DEFAULTS, *REQUIRED, "TYRESIDE", FORMAT, "FITTYP"}
"""Keys of a file that are used, apart from its units."""
SIDES = tuple(MIRRORED)


@dataclasses.dataclass(frozen=True)
class Tire:
    """A Magic Formula tire.

    coefficients: by their names in the .tir file, in SI units. side: the side of the vehicle on
    which the tire was measured, left or right. file: where it was read from.

    Raises InputError for an unknown or non-numeric coefficient and for an invalid side.
    """

    coefficients: dict[str, float]
    side: str = "left"
    file: str = ""
    version: str = "5.2"
    combined: bool = True
    notes: tuple[str, ...] = ()

    def __post_init__(self):
        for name in self.coefficients:
            if name not in TIRE.names:
                raise unknown_name(str(name), (*REQUIRED, *DEFAULTS), "coefficient")
        numbers = {n: number_of(v, n, "a number") for n, v in self.coefficients.items()}
        object.__setattr__(self, "coefficients", numbers)
        if self.side not in SIDES:
            raise InputError("side", self.side, " or ".join(SIDES))

    def record(self, pressure: float | None = None, moments: bool = False) -> np.ndarray:
        """The tire as input to the equations: an array of one TIRE record, shape (1,).

        pressure: inflation pressure (Pa); None: that of the file, else the nominal one. moments:
        whether moments are computed.
        """
        given = (self.coefficients, self.version, self.side, pressure)
        return tire_record(*given, combined=self.combined, moments=moments)

    def with_coefficients(self, **values: float) -> "Tire":
        """A copy with some coefficients replaced."""
        return dataclasses.replace(self, coefficients=self.coefficients | values)


class Entry(NamedTuple):
    """The text of a value and its place in the file: file, line and key."""

    text: str
    where: str


def load_tire(path: str | Path) -> Tire:
    """Read a tire property file (.tir); raises InputError naming file, line and key."""
    path = Path(path)
    sections = _sections(path)
    units = {name: _unit(sections.get("UNITS", {}), name) for name in UNITS}
    values = _values(sections)
    _check_format(values)
    missing = [name for name in (FORMAT, *REQUIRED) if name not in values]
    if missing:
        wanted = "all are required; `vehicle_roll_sim template --tire` writes a complete file"
        raise InputError(f"{path}: {', '.join(missing)}", None, wanted)
    coefficients = {}
    for name in (*DEFAULTS, *REQUIRED):
        unit = units["FORCE"] if name in IN_FORCE_UNITS else 1.0
        coefficients[name] = _number(values, name, unit)
    for name in ("FNOMIN", "LFZO"):
        if coefficients[name] <= 0.0:
            raise InputError(values[name].where, coefficients[name], "a number above 0")
    for name in ("PCX1", "LCX", "PCY1", "LCY", "PKY2"):
        if coefficients[name] == 0.0:
            raise InputError(values[name].where, 0.0, "any number but 0")
    for lowest, highest in zip(RANGES[::2], RANGES[1::2], strict=True):
        low, high = coefficients[lowest], coefficients[highest]
        if not low < high:
            given = values[lowest] if lowest in values else values[highest]
            raise InputError(given.where, f"{low:g} to {high:g}", f"{lowest} below {highest}")
    side = values["TYRESIDE"].text.lower() if "TYRESIDE" in values else "left"
    if side not in SIDES:
        raise InputError(values["TYRESIDE"].where, side, " or ".join(SIDES))
    return Tire(coefficients, side, str(path))


def _sections(path: Path) -> dict[str, dict[str, Entry]]:
    """Every KEY = VALUE of the file by section, keys in upper case; table rows are ignored."""
    sections: dict[str, dict[str, Entry]] = {}
    entries = None
    for number, line in enumerate(read_text(path).splitlines(), 1):
        where = f"{path}: line {number}"
        if header := HEADER.match(line):
            entries = sections.setdefault(header["name"].upper(), {})
        elif entry := ENTRY.match(line):
            if entries is None:
                raise InputError(where, "", "a [SECTION] must come first", "entry before a section")
            key = entry["key"].upper()
            if key in entries:
                raise InputError(where, key, "each key once in its section", f"second {key}")
            entries[key] = Entry(entry["value"].strip().strip("'\""), f"{where}: {key}")
        elif not IGNORED.match(line):
            raise InputError(where, line.strip()[:40], "[SECTION] or KEY = VALUE")
    return sections


def _values(sections: dict[str, dict[str, Entry]]) -> dict[str, Entry]:
    """The entries that this package uses; none may occur in two sections."""
    values = {}
    for section, entries in sections.items():
        for key in USED & entries.keys():
            if key in values:
                text, where = entries[key]
                again = f"given twice, again in [{section}]"
                raise InputError(where, text, "each coefficient in one section", again)
            values[key] = entries[key]
    return values


def _check_format(values: dict[str, Entry]) -> None:
    given = values.get(FORMAT)
    if given and given.text.upper() not in FORMATS:
        raise InputError(given.where, given.text, "one of " + ", ".join(FORMATS))
    version = values.get("FITTYP")
    if version and version.text not in FITTYPES:
        raise InputError(version.where, version.text, "one of " + ", ".join(FITTYPES))


def _unit(units: dict[str, Entry], quantity: str) -> float:
    """The value in SI of the file's unit of a quantity; 1 if the file does not define the unit."""
    if quantity not in units:
        return 1.0
    known, given = UNITS[quantity], units[quantity]
    if given.text.lower() not in known:
        raise InputError(f"{given.where}: unit", given.text, "one of " + ", ".join(known))
    return known[given.text.lower()]


def _number(values: dict[str, Entry], name: str, unit: float) -> float:
    """A coefficient in SI units, or its default."""
    if name not in values:
        return DEFAULTS[name]
    text, where = values[name]
    try:
        number = number_in(text) * unit
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise InputError(where, text, "a finite number")
    return number
