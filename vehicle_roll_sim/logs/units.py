"""Units of columns: conversion factors to SI units, by the library pint."""

import functools
import re

from vehicle_roll_sim.input_errors import InputError

UNIT = re.compile(r"(?:[^\W\d_]|(?<=[^\W\d])\d|\^-?\d(?![\d^])|[ °%/*·²³_]){1,30}")
"""A unit in text, digits only as exponents: pint would compute powers of numbers at length."""
OWN = {"g": "standard_gravity", "Nm": "N m", "1/s": "rad/s", "deg/sec": "deg/s"}
"""What vehicle logs mean by a unit that pint reads differently: g is not gram."""
INSTALL = "pip install 'vehicle_roll_sim[logs]', or columns in SI units and rad"


def factor(unit: str, wanted: str, field: str) -> float:
    """The factor from `unit` to the SI unit `wanted`; raises InputError naming `field`."""
    if unit == wanted:
        return 1.0
    allowed = f"a unit that converts to {wanted}"
    if "**" in unit or not UNIT.fullmatch(OWN.get(unit, unit)):
        raise InputError(field, unit, allowed)
    registry = _registry(field, unit)
    try:
        found = registry.Quantity(1.0, OWN.get(unit, unit)).to(wanted).magnitude
    except Exception as error:  # pint raises all sorts of errors for a text that is no unit
        problem = " ".join(str(error).split()) or f"{unit!r} is not a unit"
        raise InputError(field, unit, allowed, problem) from None
    return float(found)


@functools.cache
def _pint():
    import pint  # optional, and a fifth of a second

    return pint.UnitRegistry()


def _registry(field: str, unit: str):
    try:
        return _pint()
    except ImportError:
        raise InputError(field, unit, INSTALL, "no Python package pint") from None
