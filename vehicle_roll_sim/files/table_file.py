"""Reading a CSV file of numbers: what is wrong with it is named, with its line."""

import csv
from collections.abc import Iterator
from pathlib import Path

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.text_file import read_text

SEPARATORS = {";": "semicolons", "\t": "tabs", "|": "bars", " ": "spaces"}
"""What files have between their columns that have no commas there."""


def read_table(path: Path, largest: int) -> tuple[list[str], Iterator[tuple[int, list[str]]]]:
    """The names in the first line, and (line, texts) of every other one that is not empty.

    largest: bytes of the file. Raises InputError, also while the rows are taken, for a file that
    cannot be read or has no commas between its columns, and a line with more or fewer values than
    there are names.
    """
    reader = csv.reader(read_text(path, largest).splitlines())
    header = [name.strip() for name in _next_line(path, reader) or []]
    if len(header) == 1:
        _check_separator(path, header[0])
    return header, _rows(path, reader, len(header))


def _check_separator(path: Path, line: str) -> None:
    """A first line that no comma divides must not be one that something else divides."""
    for separator, name in SEPARATORS.items():
        if separator in line:
            wanted = "commas must separate the columns, and points the decimals"
            raise InputError(f"{path}: line 1", line, wanted, f"separated by {name}")


def _rows(path: Path, reader, width: int) -> Iterator[tuple[int, list[str]]]:
    while (row := _next_line(path, reader)) is not None:
        if row and len(row) != width:
            where = f"{path}: line {reader.line_num}"
            wanted = f"{width} values, separated by commas and with decimal points"
            raise InputError(where, "", wanted, _counted(len(row)))
        if row:
            yield reader.line_num, row


def _counted(values: int) -> str:
    return "1 value" if values == 1 else f"{values} values"


def _next_line(path: Path, reader) -> list[str] | None:
    """The texts of the next line, None at the end."""
    try:
        return next(reader, None)
    except csv.Error as error:
        where = f"{path}: line {reader.line_num}"
        raise InputError(where, "", "comma-separated values are wanted", str(error)) from None
