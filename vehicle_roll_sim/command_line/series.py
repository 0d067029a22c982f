"""`vehicle_roll_sim series`: the test series of a standard, as a table with its verdict."""

import csv
import math
from collections.abc import Iterable
from pathlib import Path

from tqdm import tqdm

from vehicle_roll_sim.arguments import (
    OneLineParser,
    add_declared,
    declared_values,
    named_file,
)
from vehicle_roll_sim.command_line import ending
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.command_line.vehicle_options import (
    add_vehicle_options,
    chosen_options,
    chosen_vehicle,
)
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.manoeuvres.series import SERIES, series_named
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.output_file import check_writable, replaced_file
from vehicle_roll_sim.simulation.summary import line

DESCRIPTION = "Drive the test series of a standard and print its table and verdict."


def series_command(words: list[str], program: str) -> int:
    """The command, given the words behind its name; returns the exit status."""
    every = dict.fromkeys(pair for series in SERIES.values() for pair in series.settings)
    first = _parser(program, every)
    named, _ = first.parse_known_args([word for word in words if word not in ("-h", "--help")])
    if named.manoeuvre is None:
        first.parse_args(words)  # for its help
        raise InputError("MANOEUVRE", None, "one of " + ", ".join(SERIES) + "; --help shows how")
    series = series_named(named.manoeuvre)
    arguments = _parser(program, series.settings).parse_args(words)
    for _, declaring in series.settings:
        series = series.with_values(declared_values(arguments, declaring))
    path = named_file(arguments.csv, "--csv")
    if path:
        check_writable(path, "--csv")
    vehicle, options = chosen_vehicle(arguments), chosen_options(arguments)
    with ending.at_once():
        compile_model()
    runs = series.rows(vehicle, options)
    rows = list(tqdm(runs, delay=1.0, disable=None, leave=False, unit=" runs"))
    if path:
        write_table(path, series.columns, rows)
    print(table(series.columns, rows))
    print(line("verdict", series.verdict(rows)))
    if path:
        print(line("CSV", path))
    return 0


def _parser(program: str, settings: Iterable[tuple[str, type]]) -> OneLineParser:
    """The parser with the options that these classes declare, under their titles."""
    parser = OneLineParser(prog=program, description=DESCRIPTION)
    parser.add_argument(
        "manoeuvre",
        metavar="MANOEUVRE",
        nargs="?",
        help=", ".join(SERIES) + "; with its name, --help shows its options",
    )
    for title, declaring in settings:
        add_declared(parser, declaring, title)
    add_declared(parser, Options, "model")
    add_vehicle_options(parser)
    parser.add_argument("--csv", metavar="FILE", help="write the table, numbers in full precision")
    return parser


def table(columns: tuple[str, ...], rows: list[tuple]) -> str:
    """Columns side by side, numbers with three decimals, whole ones with none."""
    cells = [columns, *([_cell(value) for value in row] for row in rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    lines = (
        "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
        for row in cells
    )
    return "\n".join(lines)


def _cell(value: float | str) -> str:
    if isinstance(value, str | int):
        return str(value)
    return "-" if math.isnan(value) else f"{value:.3f}"


def write_table(path: Path, columns: tuple[str, ...], rows: list[tuple]) -> None:
    """The table as CSV; the file appears whole or not at all."""
    with replaced_file(path) as partial, partial.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)
