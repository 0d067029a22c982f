"""Tire property files (.tir): sections, `$` and `!` comments, units."""

import configparser
import dataclasses
import math
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.records import LF, LR, RF, RR
from vehicle_roll_sim.model.tire import OPTIONAL, RANGES, REQUIRED, SCALING, TIRE
from vehicle_roll_sim.vehicle.text_file import read_text

FORMATS = ("MF_05", "PAC2002", "MF-TYRE")
FITTYPES = ("5", "6", "51", "52")
"""Versions 5.0 to 5.2 of the Magic Formula in the FITTYP key of MF-TYRE files."""

UNITS = {
    "LENGTH": {"meter": 1.0, "m": 1.0, "mm": 1e-3, "millimeter": 1e-3, "inch": 0.0254},
    "FORCE": {"newton": 1.0, "n": 1.0, "knewton": 1e3, "kn": 1e3, "pound_force": 4.4482216152605},
    "ANGLE": {"radians": 1.0, "radian": 1.0, "rad": 1.0},
    "MASS": {"kg": 1.0, "kilogram": 1.0},
    "TIME": {"second": 1.0, "sec": 1.0, "s": 1.0},
}
"""Units that are understood, in SI. Coefficients per degree exist in no standard, so angles must
be radians."""

IN_FORCE_UNITS = ("FNOMIN", "FZMIN", "FZMAX")
UNBOUNDED = {name: -math.inf if name.endswith("MIN") else math.inf for name in RANGES}
DEFAULTS = dict.fromkeys(SCALING, 1.0) | dict.fromkeys(OPTIONAL, 0.0) | UNBOUNDED
SIDES = {"left": (RF, RR), "right": (LF, LR)}
"""Wheels at which a tire measured on that side runs mirrored."""


@dataclasses.dataclass(frozen=True)
class Tire:
    """A Magic Formula tire: its coefficients (SI) by name, its side and its file."""

    coefficients: dict[str, float]
    side: str = "left"
    file: str = ""

    def record(self) -> np.ndarray:
        """The tire as the equations take it: one TIRE record in an array."""
        tire = np.zeros(1, TIRE)
        for name, value in self.coefficients.items():
            tire[name] = value
        tire["side"] = 1.0
        tire["side"][0, list(SIDES[self.side])] = -1.0
        return tire

    def with_coefficients(self, **values: float) -> "Tire":
        """A copy with some coefficients replaced."""
        return dataclasses.replace(self, coefficients=self.coefficients | values)


def load_tire(path: str | Path) -> Tire:
    """Read a .tir file; raises InputError naming the file and the key."""
    path = Path(path)
    values = _entries(path)
    _check_format(path, values)
    scale = {quantity: _unit(path, values, quantity) for quantity in UNITS}
    coefficients = {name: _number(path, values, name) for name in (*DEFAULTS, *REQUIRED)}
    for name in IN_FORCE_UNITS:
        coefficients[name] *= scale["FORCE"]
    for name in ("FNOMIN", "LFZO"):
        if coefficients[name] <= 0.0:
            raise InputError(f"{path}: {name}", coefficients[name], "a number above 0")
    for name in ("PCX1", "PCY1", "PKY2"):
        if coefficients[name] == 0.0:
            raise InputError(f"{path}: {name}", 0.0, "any number but 0")
    side = values.get("TYRESIDE", "left").lower()
    if side not in SIDES:
        raise InputError(f"{path}: TYRESIDE", side, " or ".join(SIDES))
    return Tire(coefficients, side, str(path))


def _entries(path: Path) -> dict[str, str]:
    """Every KEY = value of the file, whatever its section."""
    parser = configparser.ConfigParser(
        delimiters=("=",),
        comment_prefixes=("$", "!"),
        inline_comment_prefixes=("$", "!"),
        allow_no_value=True,  # tables such as [SHAPE]
        interpolation=None,
        empty_lines_in_values=False,
    )
    parser.optionxform = str.upper
    try:
        parser.read_string(read_text(path))
    except configparser.Error as error:
        problem = " ".join(str(error).replace("<string>", "the file").split())
        wanted = "[SECTION] and KEY = VALUE lines are wanted"
        raise InputError(f"tire file {path}", "", wanted, problem) from None
    return {
        key: value.strip().strip("'\"")
        for section in parser.sections()
        for key, value in parser.items(section)
        if value is not None
    }


def _check_format(path: Path, values: dict[str, str]) -> None:
    given = values.get("PROPERTY_FILE_FORMAT")
    if given is None:
        raise InputError(f"{path}: PROPERTY_FILE_FORMAT", None, "one of " + ", ".join(FORMATS))
    if given.upper() not in FORMATS:
        raise InputError(f"{path}: PROPERTY_FILE_FORMAT", given, "one of " + ", ".join(FORMATS))
    version = values.get("FITTYP", FITTYPES[0])
    if version not in FITTYPES:
        raise InputError(f"{path}: FITTYP", version, "one of " + ", ".join(FITTYPES))


def _unit(path: Path, values: dict[str, str], quantity: str) -> float:
    """The file's unit of a quantity in SI; a file without one is in SI."""
    known = UNITS[quantity]
    given = values.get(quantity, next(iter(known)))
    if given.lower() not in known:
        raise InputError(f"{path}: unit of {quantity}", given, "one of " + ", ".join(known))
    return known[given.lower()]


def _number(path: Path, values: dict[str, str], name: str) -> float:
    if name not in values and name in REQUIRED:
        raise InputError(f"{path}: {name}", None, "a number is wanted")
    text = values.get(name, DEFAULTS.get(name))
    try:
        number = float(text)
    except ValueError:
        raise InputError(f"{path}: {name}", text, "a number") from None
    if not math.isfinite(number) and name not in UNBOUNDED:
        raise InputError(f"{path}: {name}", text, "a finite number")
    return number
