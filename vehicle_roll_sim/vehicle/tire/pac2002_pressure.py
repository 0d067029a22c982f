"""Pressure in PAC2002 files: Adams adds pressure terms of its own to version 5.2."""

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire.text import Entry

TERMS = (
    *("PPX1", "PPX2", "PPX3", "PPX4", "PPY1", "PPY2", "PPY3", "PPY4", "PPY5", "PPMX1"),
    *("PPZ1", "PPZ2", "QPX1", "QPY1", "QPZ1", "QPZ2", "QSY8"),
)
"""Coefficients whose terms vanish at the pressure at which the tire was fitted."""
ACTUAL, NOMINAL, SCALE = "IP", "IP_NOM", "LIP"


def without_pressure(
    entries: dict[str, Entry], numbers: dict[str, float]
) -> tuple[dict[str, float], list[str]]:
    """The coefficients without pressure terms, if the tire is at its nominal pressure; and notes.

    Applies to files with IP or IP_NOM or of format PAC2002; others are returned unchanged.
    Raises InputError if the pressure changes the forces.
    """
    is_pac2002 = "PAC2002" in _text(entries, "PROPERTY_FILE_FORMAT").upper()
    terms = [name for name in TERMS if numbers.get(name, 0.0) != 0.0]
    if not terms or not (is_pac2002 or ACTUAL in entries or NOMINAL in entries):
        return numbers, []
    if ACTUAL in entries and NOMINAL in entries:
        scale = entries[SCALE].number() if SCALE in entries else 1.0
        if entries[ACTUAL].number() != entries[NOMINAL].number() * scale:
            problem = f"{entries[ACTUAL].text} is not {entries[NOMINAL].said}"
            allowed = f"the nominal pressure; PAC2002 terms {', '.join(terms)} are not simulated"
            raise InputError(entries[ACTUAL].where, entries[ACTUAL].text, allowed, problem)
    kept = {name: value for name, value in numbers.items() if name not in terms}
    return kept, [f"PAC2002 pressure terms vanish at nominal pressure: {', '.join(terms)}"]


def _text(entries: dict[str, Entry], key: str) -> str:
    return entries[key].text if key in entries else ""
