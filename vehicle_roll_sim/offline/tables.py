"""Conversion of results with named columns to numpy and pandas."""

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError


def structured(columns: Sequence[str], values: Sequence[np.ndarray]) -> np.ndarray:
    """A structured array, shape (n,), with these columns, each of shape (n,)."""
    dtype = [(name, column.dtype) for name, column in zip(columns, values, strict=True)]
    table = np.empty(len(values[0]), dtype)
    for name, column in zip(columns, values, strict=True):
        table[name] = column
    return table


def data_frame(table: np.ndarray, units: dict[str, str]):
    """A pandas DataFrame from a structured array, with the units in `.attrs["units"]`.

    Raises InputError if pandas is not installed.
    """
    try:
        import pandas
    except ImportError:
        raise InputError(
            "to_pandas", "", "pip install pandas", "no Python package pandas"
        ) from None
    frame = pandas.DataFrame({name: table[name] for name in table.dtype.names})
    frame.attrs["units"] = units
    return frame


def path_of(value: str | os.PathLike, field: str) -> Path:
    """The path of a file or folder; raises InputError naming `field` if `value` is not one."""
    if not isinstance(value, str | os.PathLike) or not os.fspath(value):
        raise InputError(field, value, "the name of a file or folder")
    return Path(value)


def known(name: str, columns: Sequence[str]) -> int:
    """The index of a column; raises KeyError listing the available names."""
    if name not in columns:
        raise KeyError(f"no column {name!r}: one of {', '.join(columns)}")
    return list(columns).index(name)
