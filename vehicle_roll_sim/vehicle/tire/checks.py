"""What a tire file must have, and warnings of what it seldom means."""

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire import curves
from vehicle_roll_sim.vehicle.tire.keys import COMBINED, RANGES, REQUIRED
from vehicle_roll_sim.vehicle.tire.resistance import loads_of
from vehicle_roll_sim.vehicle.tire.text import Entry
from vehicle_roll_sim.vehicle.tire.version import FITTYP, FORMAT

ABOVE_0 = (
    *("FNOMIN", "LFZO", "LONGVL", "UNLOADED_RADIUS", "VERTICAL_STIFFNESS"),
    *("INFLPRES", "NOMPRES", "LKX", "LKY"),
)
DIVISORS = ("PCX1", "LCX", "PCY1", "LCY", "PKY2")
COMPLETE = "all are required; `vehicle_roll_sim template --tire` writes a complete file"
NO_COMBINED = (
    "give the coefficients of combined slip; RBX1 = RCX1 = RBY1 = RCY1 = 0, or USE_MODE = 3 in "
    "[MODEL], switches it off"
)


def check_complete(path, numbers: dict[str, float], optional: tuple, version) -> None:
    """Raise InputError for coefficients without which there is no tire, apart from `optional`.

    version: None if the file does not say it.
    """
    missing = [name for name in REQUIRED if name not in (*numbers, *optional)]
    if missing and version and set(missing) <= set(COMBINED):
        raise InputError(f"{path}: {', '.join(missing)}", None, NO_COMBINED)
    if not version:
        missing.insert(0, f"{FITTYP} or {FORMAT}")
    if missing:
        raise InputError(f"{path}: {', '.join(missing)}", None, COMPLETE)


def check_numbers(c: dict[str, float], entries: dict[str, Entry]) -> None:
    """Raise InputError for numbers by which cannot be divided, and for ranges that are empty.

    entries: those of the numbers that count.
    """
    for name in ABOVE_0:
        if name in entries and c[name] <= 0.0:
            raise InputError(entries[name].where, c[name], "a number above 0")
    for name in DIVISORS:
        if name in entries and c[name] == 0.0:
            raise InputError(entries[name].where, 0.0, "any number but 0")
    for lowest, highest in zip(RANGES[::2], RANGES[1::2], strict=True):
        low, high = c[lowest], c[highest]
        if not low < high:
            given = entries[lowest] if lowest in entries else entries[highest]
            raise InputError(given.where, f"{low:g} to {high:g}", f"{lowest} below {highest}")


def warnings_of(c: dict[str, float], entries: dict[str, Entry], combined: bool) -> list[str]:
    """Notes on what is allowed but seldom meant."""
    notes = []
    if combined and c["RBX1"] * c["RCX1"] == 0.0:
        notes.append("combined slip is off for Fx: slip angle does not weaken it")
    if combined and c["RBY1"] * c["RCY1"] == 0.0:
        notes.append("combined slip is off for Fy: a locked wheel keeps its side force")
    for axis in "XY":
        lost = [
            load for load in loads_of(c) if curves.friction(c, axis, load) * c[f"PD{axis}1"] <= 0
        ]
        if lost:
            notes.append(f"friction of F{axis.lower()} is 0 from {min(lost):.0f} N on")
    radius = c["UNLOADED_RADIUS"]
    if "UNLOADED_RADIUS" in entries and not 0.03 <= radius <= 2.0:
        said = entries["UNLOADED_RADIUS"].said
        notes.append(f"{said}: a radius of {radius:g} m; is the unit of LENGTH right?")
    if c["QSY1"] < 0.0:
        notes.append(f"{entries['QSY1'].said}: rolling resistance that drives")
    return [f"warning: {note}" for note in notes] + _missing_moments(c)


def _missing_moments(c: dict[str, float]) -> list[str]:
    """A note on the moments for which a file has no coefficients."""
    parts = {
        "overturning": [v for n, v in c.items() if n.startswith("QSX")],
        "rolling resistance": [v for n, v in c.items() if n.startswith("QSY") and n[3] in "123456"],
        "aligning": [c[n] for n in ("QDZ1", "QDZ6", "QDZ7", "QDZ8", "QDZ9", "SSZ1", "SSZ2")],
    }
    missing = [name for name, values in parts.items() if not any(values)]
    return [f"no coefficients of the {', '.join(missing)} moment"] if missing else []
