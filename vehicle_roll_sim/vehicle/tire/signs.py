"""Signs of the coefficients: other conventions are turned into ISO, and the tire is asked.

In the axes of the format (ISO, TYDEX W: x forward, y left, z up; slip angle atan(Vy / Vx)) a
positive slip angle gives a negative lateral force. Two things can differ, alone or together:

- ADAPTED_ISO: the slip angle has the opposite sign;
- ADAPTED_SAE: y points right and z down, so that Fy, My and Mz have the opposite sign;
- SAE (J670e): y points right and z down, and the slip angle is atan(Vy / Vx) with that Vy.

Each turns the sign of those coefficients with which the formula gives the same forces in ISO axes.
A tire that is symmetric has none of those that a mirror would turn.
"""

import re

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire.curves import cornering_stiffness, nominal_load
from vehicle_roll_sim.vehicle.tire.text import Entry

KEYS_OF_SIGNS = ("SIGN_CONVENTION", "COORDINATE_SYSTEM", "AXIS_SYSTEM")
SLIP_ANGLE = frozenset(
    {
        *("PKY1", "PDY1", "PDY2", "PHY1", "PHY2", "PHY3", "PEY3", "PEY4", "RBY3", "RHX1"),
        *("RVY1", "RVY2", "RVY3", "QHZ1", "QHZ2", "QHZ3", "QHZ4", "QEZ4", "QEZ5"),
    }
)
"""Coefficients that change sign with the sign of the slip angle alone."""
AXES = frozenset(
    {
        *("PKY1", "PDY1", "PDY2", "PKY6", "PKY7", "PVY1", "PVY2", "PVY3", "PVY4"),
        *("QDZ6", "QDZ7", "QDZ8", "QDZ9", "QDZ10", "QDZ11", "SSZ1", "SSZ3", "SSZ4"),
        *("QSX3", "QSX8", "QSX13", "QSX14", "Q_FYS1", "Q_FYS2", "Q_FYS3"),
    }
)
"""Coefficients that change sign with the signs of Fy and Mz alone."""
CONVENTIONS = {
    "ADAPTED_ISO": SLIP_ANGLE,
    "ADAPTED_SAE": AXES,
    "SAE": SLIP_ANGLE ^ AXES,
}
NAMES = {
    "ISO": (),
    "ISOW": (),
    "W": (),
    "TYDEX": (),
    "TYDEXW": (),
    "ADAPTEDISO": ("ADAPTED_ISO",),
    "ADAPTEDSAE": ("ADAPTED_SAE",),
    "SAEADAPTED": ("ADAPTED_SAE",),
    "SAEJ670": ("SAE",),
    "SAEJ670E": ("SAE",),
    "SAE": ("SAE", "ADAPTED_SAE"),
    "ADAMS": ("SAE", "ADAPTED_SAE"),
}
"""What a file may call its signs, and the conventions that may be meant, the likeliest first."""
IN_COMMENT = re.compile(
    r"(?:coordinate|axis|axes|sign)[ _-]*(?:system|convention)s?\s*[:=]\s*'?(?P<name>[\w -]+)",
    re.IGNORECASE,
)
ASYMMETRIC = (
    *("RHX1", "PHY1", "PHY2", "PVY1", "PVY2", "PEY3", "RBY3", "RVY1", "RVY2", "QSX1"),
    *("QBZ4", "QDZ3", "QDZ6", "QDZ7", "QEZ4", "QHZ1", "QHZ2", "SSZ1"),
)
"""Coefficients that make a tire differ from its mirror image."""


def in_iso(
    coefficients: dict[str, float], entries: dict[str, Entry], comments: list[str]
) -> tuple[dict[str, float], list[str]]:
    """The coefficients in ISO signs, and notes; raises InputError for an unknown convention.

    A file that says nothing is taken as ISO. One whose cornering stiffness has the wrong sign in
    every convention that it may mean is refused for that later.
    """
    name, said, where = _stated(entries, comments)
    if not said:
        return coefficients, []
    meant = NAMES.get("".join(char for char in name.upper() if char.isalnum()))
    if meant is None:
        raise InputError(where, name, f"one of ISO, {', '.join(CONVENTIONS)}, ADAMS")
    turned = [(each, _turned(coefficients, CONVENTIONS[each])) for each in meant]
    if not turned:
        return coefficients, [f"{said}: as the format has it"]
    at = nominal_load(coefficients)
    right = [pair for pair in turned if cornering_stiffness(pair[1], at) < 0.0]
    convention, converted = (right or turned)[0]
    return converted, [f"{said}: converted from {convention} to ISO signs"]


def _stated(entries: dict[str, Entry], comments: list[str]) -> tuple[str, str, str]:
    """What a file calls its signs, and where, for notes and for errors; empty if nothing."""
    for key in KEYS_OF_SIGNS:
        if key in entries:
            return entries[key].text, entries[key].said, entries[key].where
    for comment in comments:
        found = IN_COMMENT.search(comment)
        name = found["name"].strip() if found else ""
        if "".join(char for char in name.upper() if char.isalnum()) in NAMES:
            return name, f"comment {comment.strip()[:40]!r}", ""
    return "", "", ""


def _turned(coefficients: dict[str, float], names: frozenset[str]) -> dict[str, float]:
    """The coefficients with the sign of some changed, and the range of slip angles with them."""
    turned = {n: -v if n in names and v else v for n, v in coefficients.items()}
    if "RHX1" in names:
        turned["ALPMIN"], turned["ALPMAX"] = -coefficients["ALPMAX"], -coefficients["ALPMIN"]
    return turned


def made_symmetric(coefficients: dict[str, float]) -> tuple[dict[str, float], list[str]]:
    """The coefficients of the tire that is its own mirror image, and a note on what was dropped."""
    dropped = [name for name in ASYMMETRIC if coefficients.get(name, 0.0)]
    notes = [f"TYRESIDE is SYMMETRIC: {', '.join(dropped)} dropped"] if dropped else []
    return coefficients | dict.fromkeys(dropped, 0.0), notes
