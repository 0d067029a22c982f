"""What a tire file must have, and warnings of values that are probably mistakes."""

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire import curves
from vehicle_roll_sim.vehicle.tire.keys import COMBINED, RANGES, REQUIRED
from vehicle_roll_sim.vehicle.tire.moments import COEFFICIENTS, has_moment
from vehicle_roll_sim.vehicle.tire.resistance import loads_of
from vehicle_roll_sim.vehicle.tire.text import Entry
from vehicle_roll_sim.vehicle.tire.version import FITTYP, FORMAT

ABOVE_0 = (
    *("FNOMIN", "LFZO", "LONGVL", "UNLOADED_RADIUS", "VERTICAL_STIFFNESS"),
    *("INFLPRES", "NOMPRES", "LKX", "LKY"),
)
AT_LEAST_0 = ("LMUX", "LMUY", "LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS")
DIVISORS = ("PCX1", "LCX", "PCY1", "LCY", "PKY2")
EXPONENTS, LARGEST_EXPONENT = ("QSY7", "QSY8"), 20
PRESSURE_RATIO = 20
"""Largest ratio of inflation pressure to nominal pressure, and of nominal to inflation pressure."""
PRESSURE_TERMS = ("PPX1", "PPX2", "PPX3", "PPX4", "PPY1", "PPY2", "PPY3", "PPY4", "PPY5", "PFZ1")
LARGEST_LOAD = 1e6
"""N: nominal load of the largest tires for mining trucks."""
LARGEST_RESISTANCE = 0.1
"""Of the load, on a hard road; car tires have 0.01."""
COMPLETE = "all are required; `vehicle_roll_sim template --tire` writes a complete file"
NO_COMBINED = (
    "give the coefficients of combined slip, or switch it off with RBX1 = RCX1 = RBY1 = RCY1 = 0 "
    "or USE_MODE = 3 in [MODEL]"
)


def check_complete(path, numbers: dict[str, float], optional: tuple, version) -> None:
    """Raise InputError if required coefficients are missing, apart from `optional`.

    version: None if the file does not reveal it.
    """
    missing = [name for name in REQUIRED if name not in (*numbers, *optional)]
    if missing and version and set(missing) <= set(COMBINED):
        raise InputError(f"{path}: {', '.join(missing)}", None, NO_COMBINED)
    if not version:
        missing.insert(0, f"{FITTYP} or {FORMAT}")
    if missing:
        raise InputError(f"{path}: {', '.join(missing)}", None, COMPLETE)


def check_numbers(c: dict[str, float], entries: dict[str, Entry]) -> None:
    """Raise InputError for a zero divisor, an empty range, or an implausible exponent or pressure.

    entries: those of the numbers that are used.
    """
    for name in ABOVE_0:
        if name in entries and c[name] <= 0.0:
            raise InputError(entries[name].where, c[name], "a number above 0")
    for name in AT_LEAST_0:
        if name in entries and c[name] < 0.0:
            raise InputError(entries[name].where, c[name], "a number of at least 0")
    for name in DIVISORS:
        if name in entries and c[name] == 0.0:
            raise InputError(entries[name].where, 0.0, "any number except 0")
    for name in EXPONENTS:
        if abs(c[name]) > LARGEST_EXPONENT:
            allowed = f"a number from {-LARGEST_EXPONENT} to {LARGEST_EXPONENT}"
            raise InputError(entries[name].where, c[name], allowed)
    ratio = 1.0 + curves.pressure_change(c)
    if not 1 / PRESSURE_RATIO <= ratio <= PRESSURE_RATIO:
        allowed = f"a pressure from 1/{PRESSURE_RATIO} to {PRESSURE_RATIO} times NOMPRES"
        raise InputError(entries["INFLPRES"].where, f"{c['INFLPRES']:g} Pa", allowed)
    for lowest, highest in zip(RANGES[::2], RANGES[1::2], strict=True):
        low, high = c[lowest], c[highest]
        if not low < high:
            given = entries[lowest] if lowest in entries else entries[highest]
            raise InputError(given.where, f"{low:g} to {high:g}", f"{lowest} below {highest}")


def warnings_of(c: dict[str, float], entries: dict[str, Entry], combined: bool) -> list[str]:
    """Notes on what is allowed but probably a mistake, and on missing moments."""
    notes = []
    if combined and c["RBX1"] * c["RCX1"] == 0.0:
        notes.append("combined slip is off for Fx: slip angle does not reduce it")
    if combined and c["RBY1"] * c["RCY1"] == 0.0:
        notes.append("combined slip is off for Fy: a locked wheel keeps its lateral force")
    for axis in "XY":
        loads = loads_of(c)
        lost = [each for each in loads if curves.friction(c, axis, each) * c[f"PD{axis}1"] <= 0.0]
        if lost:
            at = "any load" if lost == loads else f"some loads, such as {lost[0]:.0f} N"
            notes.append(f"F{axis.lower()} has no friction at {at}")
    if c["NOMPRES"] <= 0.0 and any(c[name] for name in PRESSURE_TERMS):
        notes.append("NOMPRES is not given: the pressure terms have no effect")
    radius = c["UNLOADED_RADIUS"]
    if "UNLOADED_RADIUS" in entries and not 0.03 <= radius <= 2.0:
        said = entries["UNLOADED_RADIUS"].said
        notes.append(f"{said}: a radius of {radius:g} m; is the unit of LENGTH correct?")
    if c["FNOMIN"] > LARGEST_LOAD:
        said = entries["FNOMIN"].said
        notes.append(f"{said}: a load of {c['FNOMIN']:g} N; is the unit of FORCE correct?")
    if (resistance := c["QSY1"] * c["LMY"]) < 0.0:
        notes.append(f"{entries['QSY1'].said}: negative rolling resistance, which drives the wheel")
    elif resistance > LARGEST_RESISTANCE:
        notes.append(f"{entries['QSY1'].said}: a rolling resistance of {resistance:g} of the load")
    return [f"warning: {note}" for note in notes] + _missing_moments(c)


def _missing_moments(c: dict[str, float]) -> list[str]:
    """A note on the moments for which a file has no coefficients."""
    missing = [moment for moment in COEFFICIENTS if not has_moment(moment, c)]
    return [f"no coefficients for moments: {', '.join(missing)}"] if missing else []
