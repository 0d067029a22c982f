"""USE_MODE, FE_METHOD and TYRESIDE: which forces a file is for, and which side."""

from typing import NamedTuple

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire.text import Entry

LARGEST = 999
LATERAL, UNCOMBINED, COMBINED, TURNING = 2, 3, 4, 5
"""Last digits of USE_MODE; the others select transients and the contact with the road."""
SIDES = ("left", "right", "symmetric")
MIRRORED = {"left": "right", "right": "left", "symmetric": "symmetric"}


class Mode(NamedTuple):
    """Which forces a file is for.

    lateral_only: it has no longitudinal force. combined: slip in one direction reduces the force in
    the other. mirrored: it is used as a tire of the other side.
    """

    lateral_only: bool = False
    combined: bool = True
    mirrored: bool = False
    notes: tuple[str, ...] = ()


def mode_of(entries: dict[str, Entry]) -> Mode:
    """The mode of a file; combined slip if there is no USE_MODE. Raises InputError."""
    mode = _mode(entries["USE_MODE"]) if "USE_MODE" in entries else Mode()
    ellipse = entries.get("FE_METHOD")
    if ellipse is None:
        return mode
    if ellipse.text.upper() not in ("YES", "NO"):
        raise InputError(ellipse.where, ellipse.text, "YES or NO")
    if ellipse.text.upper() == "YES" and mode.combined:
        problem = f"{ellipse.text!r}, combined slip by a friction ellipse, is not simulated"
        allowed = "NO with RBX1, RCX1, RBY1 and RCY1 for combined slip, or USE_MODE = 3 without it"
        raise InputError(ellipse.where, ellipse.text, allowed, problem)
    return mode


def _mode(entry: Entry) -> Mode:
    number = entry.number()
    if number != int(number) or abs(number) > LARGEST:
        raise InputError(entry.where, entry.text, f"a whole number from {-LARGEST} to {LARGEST}")
    digit, mirrored = int(abs(number)) % 10, number < 0
    notes = [f"{entry.said}: mirrored for the other side"] if mirrored else []
    if digit not in (LATERAL, UNCOMBINED, COMBINED, TURNING):
        allowed = "last digit 4 (combined slip), 3 (uncombined) or 2 (lateral force only)"
        raise InputError(entry.where, entry.text, allowed, f"{entry.text} has no lateral force")
    if digit == UNCOMBINED:
        notes.append(f"{entry.said}: no combined slip; a locked wheel keeps its lateral force")
    if digit == TURNING:
        notes.append(f"{entry.said}: turn slip is not simulated")
    return Mode(digit == LATERAL, digit != UNCOMBINED, mirrored, tuple(notes))


def side_of(entries: dict[str, Entry], mirrored: bool) -> tuple[str, list[str]]:
    """The side for which a tire was measured, or symmetric, and notes. Raises InputError."""
    if "TYRESIDE" not in entries:
        return MIRRORED["left"] if mirrored else "left", ["TYRESIDE is not given: taken as LEFT"]
    entry = entries["TYRESIDE"]
    side = entry.text.lower()
    if side in ("unknown", ""):
        side, notes = "left", [f"{entry.said}: taken as LEFT"]
    elif side in SIDES:
        notes = []
    else:
        raise InputError(entry.where, entry.text, "LEFT, RIGHT, SYMMETRIC or UNKNOWN")
    return MIRRORED[side] if mirrored else side, notes
