"""`vehicle_roll_sim series`: run the test series of a standard; print a table and a verdict."""

import argparse
import contextlib
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
from tqdm import tqdm

from vehicle_roll_sim.arguments import (
    OneLineParser,
    add_declared,
    declared_values,
    named_file,
)
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.command_line.vehicle_options import (
    add_road_options,
    add_vehicle_options,
    as_option,
    chosen_options,
    chosen_road,
    chosen_vehicle,
)
from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.files.output_file import (
    check_distinct,
    check_page_format,
    check_writable,
)
from vehicle_roll_sim.manoeuvres.series.base import DrivenRun, Series, kept_runs
from vehicle_roll_sim.manoeuvres.series.catalogue import SEARCHES, SERIES, series_named
from vehicle_roll_sim.manoeuvres.series.speed_search import RANGE, SpeedSearch
from vehicle_roll_sim.model.integration.events import VALUE
from vehicle_roll_sim.offline.series import SeriesResult, drive_series
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.viewer.page import write_page
from vehicle_roll_sim.viewer.recording import ViewedRun
from vehicle_roll_sim.viewer.scene import scene_of

VARIED = {
    "speed": "{:.3f} m/s",
    "speed_mph": "{:g} mph",
    "speed_kmh": "{:g} km/h",
    "scalar": "steering scalar {:g}",
}
"""How the label of a run states the value of the second column."""


def series_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    every = [*SERIES.values(), *SEARCHES.values()]
    first = _parser(program, [(t, _class_of(each)) for one in every for t, each in one.settings])
    named, _ = first.parse_known_args([word for word in words if word not in ("-h", "--help")])
    if named.manoeuvre is None:
        first.parse_args(words)  # in case of --help
        raise InputError("MANOEUVRE", None, "one of " + ", ".join(SERIES) + "; --help shows how")
    is_search = any(getattr(named, name) is not None for name in parameters_of(SpeedSearch))
    series = series_named(named.manoeuvre, is_search)
    ways_out = [RANGE] if named.manoeuvre in SEARCHES else []
    arguments = _parser(program, [*series.settings, *ways_out]).parse_args(words)
    series = _adjusted(series, arguments)
    path, page = named_file(arguments.csv, "--csv"), named_file(arguments.view, "--view")
    for file, option in ((path, "--csv"), (page, "--view")):
        if file:
            check_writable(file, option)
    if page:
        check_page_format(page, "--view")
        check_distinct({"--csv": path, "--view": page})
    vehicle = chosen_vehicle(arguments)
    options = chosen_options(arguments, vehicle)
    road = chosen_road(arguments)
    with signals.exit_on_signal():
        compile_model()
    try:
        with (
            tqdm(delay=1.0, disable=None, leave=False, unit=" runs") as bar,
            kept_runs() if page else contextlib.nullcontext() as kept,
        ):
            result = _driven(series, vehicle, options, bar.update, road)
    except BaseException as end:  # a refusal, a failure or a signal, after some of the runs
        if getattr(end, "driven", ()):
            _show(end.driven, path)
        raise
    _show(result, path)
    if page:
        scene = scene_of(vehicle, options)
        _write_page(page, f"series {arguments.manoeuvre}", result, kept, scene, road)
        print(line("page", page))
    return 0


def _write_page(
    path: Path, title: str, result: SeriesResult, kept: list[DrivenRun], scene: dict, road: Road
) -> None:
    """Write the page of all runs; the one that rolls most is shown first."""
    varied = VARIED[result.columns[1]]
    labels = [f"{row[0]}, {varied.format(row[1])}" for row in result.rows]
    runs = [
        ViewedRun(run.history, run.events, label, scene, road)
        for run, label in zip(kept, labels, strict=True)
    ]
    worst = int(np.argmax([abs(run.events.peak_roll[VALUE]) for run in kept]))
    write_page(path, runs, title, getattr(kept[worst].manoeuvre, "cones", ()), shown=[worst])


def _show(result: SeriesResult, path: Path | None) -> None:
    """Print the result, and write it to the CSV file if there is one."""
    if path:
        result.write_csv(path)
    print(result.table)
    for label, text in result.remarks.items():
        print(line(label, text))
    print(line("verdict", result.verdict))
    if path:
        print(line("CSV", path))


def _adjusted(series: Series, arguments: argparse.Namespace) -> Series:
    """The series with the values from the command line."""
    values = {}
    for _, declaring in series.settings:
        values |= declared_values(arguments, declaring)
    try:
        return series.with_values(values)
    except InputError as error:
        raise as_option(error) from None


def _driven(
    series: Series,
    vehicle: Vehicle,
    options: Options,
    progress: Callable[[], object],
    road: Road,
) -> SeriesResult:
    """Run the series; an error in the model options is reported under the option's name."""
    try:
        return drive_series(series, vehicle, options, progress, road)
    except InputError as error:
        if error.field not in parameters_of(Options):
            raise
        named = as_option(error)
        named.driven = getattr(error, "driven", ())
        raise named from None


def _class_of(declaring) -> type:
    return declaring if isinstance(declaring, type) else type(declaring)


def _parser(program: str, settings: Iterable[tuple[str, object]]) -> OneLineParser:
    """The parser with the options of these classes or instances, grouped under their titles."""
    parser = OneLineParser(prog=program, description=COMMANDS["series"])
    parser.add_argument(
        "manoeuvre",
        metavar="MANOEUVRE",
        nargs="?",
        help=", ".join(SERIES) + "; for a search over entry speeds: " + ", ".join(SEARCHES),
    )
    for title, declaring in settings:
        add_declared(parser, declaring, title, without=SpeedSearch.fixed)
    add_declared(parser, Options, "model")
    add_road_options(parser)
    add_vehicle_options(parser)
    parser.add_argument("--csv", metavar="FILE", help="write the table in full precision (CSV)")
    about = "write a page (HTML) that shows up to four of the runs in a browser, as `view` does"
    parser.add_argument("--view", metavar="FILE", help=about)
    return parser
