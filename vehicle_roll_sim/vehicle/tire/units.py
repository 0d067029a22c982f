"""Units of tire files: the names used by Adams and other programs, and the factors to SI."""

import math

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire.text import Entry

POUND = 0.45359237
GRAVITY = 9.80665
POUND_FORCE = 4.4482216152605
INCH = 0.0254

LENGTHS = {
    1.0: ("meter", "meters", "metre", "m"),
    1e-3: ("mm", "millimeter", "millimeters", "millimetre"),
    1e-2: ("cm", "centimeter", "centimeters", "centimetre"),
    1e3: ("km", "kilometer", "kilometers", "kilometre"),
    INCH: ("inch", "inches", "in"),
    12 * INCH: ("foot", "feet", "ft"),
    36 * INCH: ("yard", "yards", "yd"),
    63360 * INCH: ("mile", "miles", "mi"),
}
FORCES = {
    1.0: ("newton", "newtons", "n"),
    1e3: ("kn", "knewton", "knewtons", "kilonewton", "kilonewtons"),
    1e6: ("mn", "meganewton"),
    1e-2: ("cn", "centinewton"),
    1e-3: ("millinewton",),
    1e-5: ("dyne", "dyn"),
    POUND_FORCE: ("pound_force", "lbf", "lb_force", "pound", "lb"),
    1e3 * POUND_FORCE: ("kpound_force", "klbf", "kip"),
    POUND_FORCE / 16: ("ounce_force", "ozf"),
    GRAVITY: ("kg_force", "kilogram_force", "kgf"),
    POUND * 0.3048: ("poundal", "pdl"),
}
ANGLES = {
    1.0: ("radians", "radian", "rad"),
    math.pi / 180: ("degrees", "degree", "deg"),
    math.pi / 10_800: ("angular_minutes", "angular_minute"),
    math.pi / 648_000: ("angular_seconds", "angular_second"),
    2 * math.pi: ("revolutions", "revolution", "rev"),
}
MASSES = {
    1.0: ("kg", "kilogram", "kilograms"),
    1e-3: ("gram", "grams", "g"),
    1e3: ("tonne", "t"),
    POUND: ("pound_mass", "lbm", "pound", "lb"),
    1e3 * POUND: ("kpound_mass", "klbm"),
    POUND / 16: ("ounce_mass", "ozm"),
    POUND_FORCE / 0.3048: ("slug", "slugs"),
    POUND_FORCE / INCH: ("slinch",),
    2e3 * POUND: ("us_ton",),
}
TIMES = {
    1.0: ("second", "seconds", "sec", "s"),
    1e-3: ("millisecond", "milliseconds", "msec", "ms", "milli"),
    60.0: ("minute", "minutes", "min"),
    3600.0: ("hour", "hours", "h"),
}
PRESSURES = {
    1.0: ("pascal", "pascals", "pa", "newton/meter**2", "n/m^2", "n/m2"),
    1e3: ("kpascal", "kilopascal", "kpa"),
    1e6: ("mpascal", "megapascal", "mpa", "n/mm^2", "n/mm2"),
    1e5: ("bar",),
    POUND_FORCE / INCH**2: ("psi", "lbf/in^2"),
    1e3 * POUND_FORCE / INCH**2: ("ksi",),
}
UNITS = {
    "LENGTH": LENGTHS,
    "FORCE": FORCES,
    "ANGLE": ANGLES,
    "MASS": MASSES,
    "TIME": TIMES,
    "PRESSURE": PRESSURES,
}
"""By quantity: the unit in SI, and its names in lower case."""


def factors(units: dict[str, Entry]) -> dict[str, float]:
    """Factors to SI units by dimension, from the entries of [UNITS]; SI where none is given.

    Coefficients without a dimension have the factor 1, including angles and those per angle: no fit
    gives coefficients per degree. Raises InputError for an unknown unit.
    """
    values = {name: _value_of(units[name]) if name in units else 1.0 for name in UNITS}
    length, force = values["LENGTH"], values["FORCE"]
    return {
        "": 1.0,
        "length": length,
        "curvature": 1.0 / length,
        "force": force,
        "stiffness": force / length,
        "speed": length / values["TIME"],
        "angle": values["ANGLE"],
        "pressure": values["PRESSURE"] if "PRESSURE" in units else force / length**2,
    }


def converted(units: dict[str, Entry]) -> list[str]:
    """A note on the units of a file that are not SI."""
    others = [e.said for e in units.values() if e.key in UNITS and _value_of(e) != 1.0]
    return [f"converted to SI units: {', '.join(others)}"] if others else []


def _value_of(entry: Entry) -> float:
    known = UNITS[entry.key]
    for value, names in known.items():
        if entry.text.strip().casefold() in names:
            return value
    allowed = ", ".join(names[0] for names in known.values())
    raise InputError(f"{entry.where}: unit", entry.text, f"one of {allowed}")
