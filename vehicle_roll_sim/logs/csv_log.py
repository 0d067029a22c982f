"""Logs as text: separators and decimal commas are named by the map or found in the file."""

import csv
import math
from pathlib import Path

import numpy as np

from vehicle_roll_sim.files.text_file import read_text
from vehicle_roll_sim.input_errors import InputError, number_in
from vehicle_roll_sim.logs.map_file import LogMap
from vehicle_roll_sim.logs.raw_log import RawLog, check_column

LARGEST_FILE = 500_000_000
"""Bytes."""
ENCODINGS = ("utf-8-sig", "latin-1")
SEPARATORS = (";", "\t", "|", ",", " ")
"""In this order: of a file with decimal commas, the comma is not the separator."""
NAMES = {",": "commas", ";": "semicolons", "\t": "tabs", "|": "bars", " ": "spaces"}
MISSING = ("", "nan", "na", "n/a", "null", "none", "-")
LOOKED_AT = 20
"""Rows in which a decimal comma is looked for."""


def read_csv_log(path: Path, log_map: LogMap) -> RawLog:
    """The mapped columns of a CSV file; raises InputError naming line and column."""
    lines = read_text(path, LARGEST_FILE, ENCODINGS).splitlines()
    first = log_map.first_line - 1
    if len(lines) <= first or not any(line.strip() for line in lines[first:]):
        raise InputError(f"file {path}", "", "a line of names and at least one row", "no rows")
    header_line = lines[log_map.header_line - 1]
    separator = log_map.separator or _separator_of(header_line)
    header = _names(path, header_line, log_map.header_line, separator)
    for column in log_map.columns.values():
        check_column(column.name, header, column.field)
    places = {each.name: header.index(each.name) for each in log_map.columns.values()}
    rows = _rows(path, lines, first, separator, len(header))
    decimal = log_map.decimal or _decimal_of(rows, separator, places)
    read = [
        [_number(path, line, name, row[place], decimal) for name, place in places.items()]
        for line, row in rows
    ]
    columns = dict(zip(places, np.array(read).T, strict=True))
    notes = [f"read: columns separated by {NAMES[separator]}"]
    if decimal == ",":
        notes[0] += ", decimal commas"
    return RawLog(columns, notes=notes if (separator, decimal) != (",", ".") else [])


def _separator_of(header: str) -> str:
    """The separator of a line of names: a comma if there is none."""
    return next((each for each in SEPARATORS if each in header), ",")


def _names(path: Path, text: str, line: int, separator: str) -> list[str]:
    """The names of the columns."""
    try:
        return [name.strip() for name in next(csv.reader([text], delimiter=separator))]
    except csv.Error as error:
        raise InputError(f"{path}: line {line}", "", "names of columns", str(error)) from None


def _rows(
    path: Path, lines: list[str], first: int, separator: str, width: int
) -> list[tuple[int, list[str]]]:
    """(line number, texts) of every row that is not empty."""
    reader = csv.reader(lines[first:], delimiter=separator)
    rows = []
    try:
        for row in reader:
            line = first + reader.line_num
            if row and len(row) != width:
                wanted = f"{width} values, separated by {NAMES[separator]}, as in the line of names"
                raise InputError(f"{path}: line {line}", "", wanted, f"{len(row)} values")
            if row:
                rows.append((line, row))
    except csv.Error as error:
        where = f"{path}: line {first + reader.line_num}"
        raise InputError(where, "", "rows of values", str(error)) from None
    return rows


def _decimal_of(rows: list[tuple[int, list[str]]], separator: str, places: dict[str, int]) -> str:
    """A comma if numbers of the first rows have commas and none has a point."""
    texts = [row[place] for _, row in rows[:LOOKED_AT] for place in places.values()]
    has_commas = separator != "," and any("," in text for text in texts)
    return "," if has_commas and not any("." in text for text in texts) else "."


def _number(path: Path, line: int, name: str, text: str, decimal: str) -> float:
    """A number, nan where it is missing."""
    plain = text.strip()
    if plain.casefold() in MISSING:
        return math.nan
    if decimal == ",":
        plain = "x" if "." in plain else plain.replace(",", ".")
    try:
        value = number_in(plain)
    except ValueError:
        value = math.inf
    if math.isinf(value):
        kind = "comma" if decimal == "," else "point"
        allowed = f"a number with a decimal {kind}, or nothing"
        raise InputError(f"{path}: line {line}: {name}", text, allowed)
    return value
