"""`vehicle_roll_sim view`: a page that shows recorded runs in a browser."""

import argparse
import math
import sys
from pathlib import Path

import numpy as np

from vehicle_roll_sim.arguments import OneLineParser, add_declared, named_file
from vehicle_roll_sim.command_line import view_live
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.recorded_runs import (
    add_names,
    add_runs,
    check_output,
    files_of,
    labels_of,
    output_of,
    part_of,
    part_settings,
    run_from,
)
from vehicle_roll_sim.command_line.signals import PROGRAM
from vehicle_roll_sim.command_line.vehicle_options import (
    add_vehicle_options,
    chosen_options,
    chosen_vehicle,
)
from vehicle_roll_sim.command_line.view_pictures import add_pictures, pictures_of
from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.files.output_file import check_page_format
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD, manoeuvre_named
from vehicle_roll_sim.manoeuvres.double_lane_change import DoubleLaneChange
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.sampled_events import events_of
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_DEGREES
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.vehicle_file import TIRES
from vehicle_roll_sim.viewer.page import MOST_RUNS, write_page
from vehicle_roll_sim.viewer.recording import ViewedRun
from vehicle_roll_sim.viewer.scene import scene_of

WITH_CONES = tuple(name for name, each in STANDARD.items() if isinstance(each, DoubleLaneChange))
OF_CSV = ("vehicle", *TIRES, "set", "model", "road")
"""Options that describe the vehicle and the road of a CSV file, which does not name them."""
AT_REST = 1e-6
"""m: tolerance of the c.g. height at which a run begins."""


def view_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    if view_live.LIVE in words:
        return view_live.live_command(words, program)
    arguments = _parser(program).parse_args(words)
    files = files_of(arguments, "RUN", MOST_RUNS, "the number of colours")
    settings, output = part_settings(arguments), _output(arguments, files)
    pictures = pictures_of(arguments, output, files)
    labels = labels_of(arguments.label, files)
    read = [run_from(file, arguments.namespace, "RUN", with_forces=True) for file in files]
    chosen = _chosen(arguments, [told is None for _, told in read])
    runs, notes, cones = [], [], []
    for file, label, (history, told) in zip(files, labels, read, strict=True):
        vehicle, options, road = (told.vehicle, told.options, told.road) if told else chosen
        angle = told.rollover_angle if told else math.radians(DEFAULT_ROLLOVER_DEGREES)
        if "stop_roll" in settings:
            angle = math.radians(settings["stop_roll"])
        if told is None:
            notes.append(_note(label, arguments.vehicle))
            _warn_of_another_vehicle(file, history, vehicle)
        part, scene = part_of(history, settings, file), scene_of(vehicle, options)
        runs.append(ViewedRun(part, events_of(history, angle), label, scene, road))
        if arguments.manoeuvre and not len(cones):
            cones = _cones(arguments.manoeuvre, vehicle, options)
    begin = min(float(run.history["time"][0]) for run in runs)
    end = max(float(run.history["time"][-1]) for run in runs)
    pictures.check_times(begin, end)
    title = arguments.title if arguments.title is not None else ", ".join(labels)
    write_page(output, runs, title, cones, notes)
    print(line("page", output))
    pictures.write(begin, end)
    return 0


def _parser(program: str) -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=program,
        description=COMMANDS["view"],
        epilog="The vehicle options and --road are for CSV files. A bag or study states its "
        "vehicle, its road and the roll angle at which its run stops.",
    )
    add_runs(parser, "RUN")
    parser.add_argument(view_live.LIVE, action="store_true", help=view_live.ABOUT)
    group = parser.add_argument_group("results")
    group.add_argument(
        "--out",
        metavar="FILE",
        help="page to write, in HTML (default for a single run: its name with .html)",
    )
    add_names(group, "page", "the labels of the runs")
    group.add_argument(
        "--manoeuvre",
        metavar="NAME",
        help="show the cones of this manoeuvre: " + ", ".join(WITH_CONES),
    )
    add_pictures(parser)
    add_vehicle_options(parser)
    about = "road file (YAML) for CSV files; its features are shown"
    parser.add_argument_group("road").add_argument("--road", metavar="FILE", help=about)
    others = [name for name in parameters_of(Options) if name != "model"]
    add_declared(parser, Options, "vehicle", without=others)
    return parser


def _output(arguments: argparse.Namespace, files: list[Path]) -> Path:
    """Where the page goes, checked."""
    output = output_of(arguments.out, "--out", ".html", files)
    check_page_format(output, "--out")
    check_output(output, "--out", files)
    if arguments.manoeuvre is not None and arguments.manoeuvre not in WITH_CONES:
        raise InputError("--manoeuvre", arguments.manoeuvre, "one of " + ", ".join(WITH_CONES))
    return output


def _chosen(
    arguments: argparse.Namespace, are_of_options: list[bool]
) -> tuple[Vehicle, Options, Road | None] | None:
    """The vehicle and road that the options describe, if a run needs them; raises InputError."""
    if any(are_of_options):
        vehicle, file = chosen_vehicle(arguments), named_file(arguments.road, "--road")
        return vehicle, chosen_options(arguments, vehicle), Road.from_file(file) if file else None
    for name in OF_CSV:
        if value := getattr(arguments, name):
            option = "--" + name.replace("_", "-")
            what = name if name == "road" else "vehicle"
            raise InputError(option, value, "only for CSV files", f"the run describes its {what}")
    return None


def _note(label: str, vehicle: str | None) -> str:
    drawn = "the reference vehicle" if vehicle is None else vehicle
    return f"{label}: drawn with the dimensions of {drawn}, since a CSV file has none of its own."


def _warn_of_another_vehicle(path: Path, history: History, vehicle: Vehicle) -> None:
    """Print a warning if the c.g. is not at the height of the vehicle when a run begins."""
    time, height = history["time"][0], float(history["z"][0])
    if time == 0.0 and abs(height - vehicle.cg_height) > AT_REST:
        print(
            f"{PROGRAM}: warning: {path}: the sprung c.g. is at {height:g} m at first, but at "
            f"{vehicle.cg_height:g} m in the vehicle drawn: give --vehicle or --set",
            file=sys.stderr,
        )


def _cones(name: str, vehicle: Vehicle, options: Options) -> np.ndarray:
    """The cones of a manoeuvre with its default settings, (n, 2) (m)."""
    return manoeuvre_named(name).for_vehicle(vehicle, options).cones
