"""Reading a CSV file of numbers: what is wrong with it is named, with its line."""

import csv
from collections.abc import Iterator
from pathlib import Path

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.text_file import read_text


def read_table(path: Path, largest: int) -> tuple[list[str], Iterator[tuple[int, list[str]]]]:
    """The names in the first line, and (line, texts) of every other one that is not empty.

    largest: bytes of the file. Raises InputError, also while the rows are taken, for a file that
    cannot be read and a line with more or fewer values than there are names.
    """
    reader = csv.reader(read_text(path, largest).splitlines())
    header = [name.strip() for name in _next_line(path, reader) or []]
    return header, _rows(path, reader, len(header))


def _rows(path: Path, reader, width: int) -> Iterator[tuple[int, list[str]]]:
    while (row := _next_line(path, reader)) is not None:
        if row and len(row) != width:
            where = f"{path}: line {reader.line_num}"
            raise InputError(where, f"{len(row)} values", f"{width} values")
        if row:
            yield reader.line_num, row


def _next_line(path: Path, reader) -> list[str] | None:
    """The texts of the next line, None at the end."""
    try:
        return next(reader, None)
    except csv.Error as error:
        where = f"{path}: line {reader.line_num}"
        raise InputError(where, "", "comma-separated values are wanted", str(error)) from None
