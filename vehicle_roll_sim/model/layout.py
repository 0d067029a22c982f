"""How records are laid out: the order of wheels, and fields of numbers, wheels and vectors.

The order of wheels is lf, rf, lr, rr everywhere.
"""

import numpy as np

WHEELS = ("lf", "rf", "lr", "rr")
WHEEL_COUNT = len(WHEELS)
CORNERS = tuple(f"{end}_{wheel}" for end in ("floor", "roof") for wheel in WHEELS)
"""Corners of the body: those of its floor, then of its roof, named after the wheels."""
CORNER_COUNT = len(CORNERS)
AXLE_COUNT = 2


def record_dtype(*fields) -> np.dtype:
    """A structured dtype of float64 fields, whose elements have their fields as attributes.

    fields: names (scalars), or pairs (name, shape) or (name, type), which may be another dtype.
    """
    return np.dtype((np.record, [_field(field) for field in fields]))


def place_in(dtype: np.dtype, name: str) -> int | slice:
    """Where the numbers of a field are among those of a record: an index, or a slice of several."""
    field, offset = dtype.fields[name]
    first = offset // 8
    return slice(first, first + field.itemsize // 8) if field.shape else first


def vectors(*names: str) -> tuple:
    """Fields with a vector (x, y, z) per wheel, shape (3, 4)."""
    return tuple((name, (3, WHEEL_COUNT)) for name in names)


def _field(field):
    if isinstance(field, str):
        return (field, np.float64)
    name, kind = field
    return (name, kind) if isinstance(kind, (type, np.dtype)) else (name, np.float64, kind)


def per_wheel(*names: str) -> tuple:
    """Fields with one value per wheel."""
    return tuple((name, WHEEL_COUNT) for name in names)
