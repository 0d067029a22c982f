"""Unknown keys of a tire file: misspelt ones are refused, the others are noted."""

import difflib
import re

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire.keys import KEYS, MATTERING
from vehicle_roll_sim.vehicle.tire.text import UNITS, Entry
from vehicle_roll_sim.vehicle.tire.units import UNITS as QUANTITIES

OF_COEFFICIENTS = re.compile(
    r"DIMENSION|OPERATING_CONDITIONS?|TIRE_CONDITIONS?|VERTICAL|STRUCTURAL|SCALING.*"
    r"|\w+_RANGE|(LONGITUDINAL|LATERAL|OVERTURNING|ROLLING|ALIGNING|TURNSLIP)\w*"
)
"""Sections in which every key is a coefficient."""
LIKE_A_COEFFICIENT = re.compile(r"[PQRS]_?[A-Z]{1,3}\d{1,2}")
ALIKE = 0.8
"""Smallest similarity (0 to 1) at which a key outside these sections counts as misspelt."""
MOST_SHOWN = 8


def pass_over(entries: list[Entry]) -> list[str]:
    """Notes on unknown keys that are ignored; raises InputError for one that may matter."""
    unknown = [entry for entry in entries if not _is_known(entry)]
    for entry in unknown:
        inside = OF_COEFFICIENTS.fullmatch(entry.section) is not None
        nearest = _nearest(entry, 0.5 if inside else ALIKE)
        if inside or nearest or LIKE_A_COEFFICIENT.fullmatch(entry.key):
            meant = f"did you mean {nearest}? " if nearest else ""
            allowed = f"{meant}A key that may affect forces is not ignored: correct or delete it"
            raise InputError(entry.where, entry.text, allowed, f"{entry.key} is unknown")
    names = list(dict.fromkeys(f"[{entry.section}] {entry.key}" for entry in unknown))
    if not names:
        return []
    more = f" and {len(names) - MOST_SHOWN} more" if len(names) > MOST_SHOWN else ""
    return [f"ignored, not Magic Formula keys: {', '.join(names[:MOST_SHOWN])}{more}"]


def _is_known(entry: Entry) -> bool:
    return entry.key in (QUANTITIES if entry.section == UNITS else KEYS)


def _nearest(entry: Entry, cutoff: float) -> str:
    """The known key most similar to an unknown one; empty if none is similar."""
    known = QUANTITIES if entry.section == UNITS else MATTERING
    nearest = difflib.get_close_matches(entry.key, known, n=1, cutoff=cutoff)
    return nearest[0] if nearest else ""
