"""CSV files: numbers are read, and errors name the line; rows are written."""

import csv
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.files.text_file import read_text

SEPARATORS = {";": "semicolons", "\t": "tabs", "|": "bars", " ": "spaces"}
"""Column separators that are recognized but not accepted, with their names."""


def read_table(path: Path, largest: int) -> tuple[list[str], Iterator[tuple[int, list[str]]]]:
    """The column names, and an iterator of (line number, texts) over the non-empty lines.

    largest: maximum size of the file (bytes). Raises InputError, also during iteration, if the file
    cannot be read or is not comma-separated, or if a line has more or fewer values than there are
    names.
    """
    reader = csv.reader(read_text(path, largest).splitlines())
    header = [name.strip() for name in _next_line(path, reader) or []]
    if len(header) == 1:
        _check_separator(path, header[0])
    return header, _rows(path, reader, len(header))


def write_rows(path: Path, columns: Sequence[str], rows: Iterable[Sequence]) -> None:
    """Write rows as CSV in full precision; the file is written completely or not at all."""
    with replaced_file(path) as partial, partial.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def _check_separator(path: Path, line: str) -> None:
    """Raise InputError if a first line without commas has another separator."""
    for separator, name in SEPARATORS.items():
        if separator in line:
            wanted = "columns must be separated by commas, with decimal points"
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
    """The texts of the next line, or None at the end of the file."""
    try:
        return next(reader, None)
    except csv.Error as error:
        where = f"{path}: line {reader.line_num}"
        raise InputError(where, "", "expected comma-separated values", str(error)) from None
