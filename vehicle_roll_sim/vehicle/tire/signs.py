"""Sign conventions of the coefficients, and their conversion to ISO.

In the axes of the format (ISO, TYDEX W: x forward, y left, z up; slip angle atan(Vy / Vx)) a
positive slip angle gives a negative lateral force. Two things can differ, alone or together:

- ADAPTED_ISO: the slip angle has the opposite sign;
- ADAPTED_SAE: y points right and z down, so that Fy, My and Mz have the opposite sign;
- SAE (J670e): y points right and z down, and the slip angle is atan(Vy / Vx) with that Vy.

For each, the signs of certain coefficients are changed so that the formula gives the same forces in
ISO axes. A symmetric tire has none of the coefficients that would differ in its mirror image.
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
"""Coefficients that change sign if only the slip angle changes sign."""
AXES = frozenset(
    {
        *("PKY1", "PDY1", "PDY2", "PKY6", "PKY7", "PVY1", "PVY2", "PVY3", "PVY4"),
        *("QDZ6", "QDZ7", "QDZ8", "QDZ9", "QDZ10", "QDZ11", "SSZ1", "SSZ3", "SSZ4"),
        *("QSX3", "QSX8", "QSX13", "QSX14", "Q_FYS1", "Q_FYS2", "Q_FYS3"),
    }
)
"""Coefficients that change sign if only Fy, My and Mz change sign."""
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
"""Names of sign conventions in files, and the conventions they may mean, likeliest first."""
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

    A file that names no convention is taken as ISO. If the cornering stiffness has the wrong sign
    in every convention that the name may mean, a later check refuses the file.
    """
    name, said, where = _stated(entries, comments)
    if not said:
        return coefficients, []
    meant = NAMES.get("".join(char for char in name.upper() if char.isalnum()))
    if meant is None:
        raise InputError(where, name, f"one of ISO, {', '.join(CONVENTIONS)}, ADAMS")
    turned = [(each, _turned(coefficients, CONVENTIONS[each])) for each in meant]
    if not turned:
        return coefficients, [f"{said}: the signs of the format"]
    at = nominal_load(coefficients)
    right = [pair for pair in turned if cornering_stiffness(pair[1], at) < 0.0]
    convention, converted = (right or turned)[0]
    return converted, [f"{said}: converted from {convention} to ISO signs"]


def _stated(entries: dict[str, Entry], comments: list[str]) -> tuple[str, str, str]:
    """The sign convention that a file names, and its place for notes and for errors; else empty."""
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
    """The coefficients with the signs of some changed, and the slip-angle range accordingly."""
    turned = {n: -v if n in names and v else v for n, v in coefficients.items()}
    if "RHX1" in names:
        turned["ALPMIN"], turned["ALPMAX"] = -coefficients["ALPMAX"], -coefficients["ALPMIN"]
    return turned


def made_symmetric(coefficients: dict[str, float]) -> tuple[dict[str, float], list[str]]:
    """The coefficients of a tire equal to its mirror image, and a note on what was dropped."""
    dropped = [name for name in ASYMMETRIC if coefficients.get(name, 0.0)]
    notes = [f"TYRESIDE is SYMMETRIC: {', '.join(dropped)} dropped"] if dropped else []
    return coefficients | dict.fromkeys(dropped, 0.0), notes
