"""What a file holds before a map gives it a meaning: columns of numbers, by name."""

import dataclasses
from collections.abc import Iterable

import numpy as np

from vehicle_roll_sim.input_errors import InputError, unknown_name

Channel = tuple[np.ndarray, np.ndarray]
"""Times (s) and values of the same length, shape (n,)."""


@dataclasses.dataclass
class RawLog:
    """Columns as a reader finds them, nan where a value is missing.

    columns: values (n,) by name. times: of each column (s), shape (n,); empty if the rows have a
    column of times. units: of the columns whose file states them. notes: what the reader assumed.
    """

    columns: dict[str, np.ndarray]
    times: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)
    units: dict[str, str] = dataclasses.field(default_factory=dict)
    notes: list[str] = dataclasses.field(default_factory=list)


def check_column(name: str, known: Iterable[str], field: str) -> None:
    """Raise InputError naming `field` unless the file has the column, once."""
    known = list(known)
    if name not in known:
        raise unknown_name(name, known, f"{field}: column")
    if known.count(name) > 1:
        raise InputError(f"{field}: column", name, "a column that the file has once")


def as_numbers(values, field: str, name: str) -> np.ndarray:
    """Values of a library's column as floats, shape (n,); raises InputError naming `field`."""
    try:
        array = np.asarray(values, float).ravel()
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{field}: column", name, "a column of numbers") from None
    return array
