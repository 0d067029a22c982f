"""Coefficients by name, with what a file of each version leaves to its reader."""

import math
import re
from pathlib import Path

import numpy as np

DEFAULTS = {"PKY4": 2.0, "Q_RE0": 1.0, "QSY7": 1.0, "LONGVL": 16.7}
"""Defaults that are neither 0 nor, for a scaling factor, 1."""
ENTRY = re.compile(r"\s*(\w+)\s*=\s*'?([^'$!]*)")
VERSIONS = {"5": "5.2", "6": "5.2", "51": "5.2", "52": "5.2", "61": "6.1", "62": "6.2"}
UNITS = {
    "meter": 1.0,
    "mm": 1e-3,
    "newton": 1.0,
    "kn": 1e3,
    "second": 1.0,
    "millisecond": 1e-3,
}
DIMENSIONS = {
    "UNLOADED_RADIUS": ("LENGTH",),
    "WIDTH": ("LENGTH",),
    "LONGVL": ("LENGTH", "/TIME"),
    "FNOMIN": ("FORCE",),
    "VERTICAL_STIFFNESS": ("FORCE", "/LENGTH"),
    "INFLPRES": ("FORCE", "/LENGTH", "/LENGTH"),
    "NOMPRES": ("FORCE", "/LENGTH", "/LENGTH"),
    "Q_CAM2": ("/LENGTH",),
    "Q_FYS1": ("FORCE",),
    "Q_FYS2": ("FORCE",),
    "Q_FYS3": ("FORCE",),
}
"""Units that the evaluated coefficients have; /X: to the power of -1. All others have none."""


class Coefficients(dict):
    """Numbers by name; those that the file does not give are the defaults of its version.

    lowest_weight: where the weighting functions of combined slip end. The formula as published has
    no such end, and its weights turn negative far beyond the peak (lowest_weight=-inf).
    """

    def __init__(self, given, version="5.2", lowest_weight=0.0):
        super().__init__({name: np.float64(value) for name, value in given.items()})
        self.version, self.lowest_weight = version, lowest_weight

    def __missing__(self, name):
        if name in DEFAULTS:
            return DEFAULTS[name]
        return np.float64(name.startswith("L"))

    def as_published(self):
        return Coefficients(self, self.version, -math.inf)


def complete(p):
    """`p` with defaults; coefficients without a version are those of 5.2."""
    return p if isinstance(p, Coefficients) else Coefficients(p)


def read(path):
    """The coefficients of a file in SI units, and the side it was made for, taken at its word."""
    texts = {}
    for line in Path(path).read_text(encoding="latin-1").splitlines():
        if found := ENTRY.match(line):
            texts[found[1].upper()] = found[2].strip()
    numbers = {name: float(text) for name, text in texts.items() if is_number(text)}
    for name in DIMENSIONS.keys() & numbers.keys():
        for unit in DIMENSIONS[name]:
            size = UNITS[texts[unit.lstrip("/")].lower()]
            numbers[name] *= 1 / size if unit.startswith("/") else size
    return Coefficients(numbers, VERSIONS[texts["FITTYP"]]), texts["TYRESIDE"].lower()


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True
