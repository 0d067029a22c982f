"""`vehicle_roll_sim plot`: the standard figure of one recorded run, or of several overlaid."""

import argparse
import dataclasses
import math
import os
from pathlib import Path

from vehicle_roll_sim.analysis import figure_size
from vehicle_roll_sim.arguments import OneLineParser, add_declared, declared_values, named_file
from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.files.output_file import check_figure_format, check_writable
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.sampled_events import events_of
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.simulation import DEFAULT_ROLLOVER_DEGREES

LATEST = 1e10
"""s: later than any time, including times counted from 1970."""


@dataclasses.dataclass(frozen=True)
class PlotSettings:
    """Which part of the runs is plotted, and what counts as a rollover in it."""

    begin: float = parameter("plot from this time on (default: the first sample)", "s", 0.0, LATEST)
    end: float = parameter("plot up to this time (default: the last sample)", "s", 0.0, LATEST)
    stop_roll: float = parameter(
        "roll angle that counts as a rollover", "deg", 1.0, 90.0, default=DEFAULT_ROLLOVER_DEGREES
    )


def plot_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    arguments = _parser(program).parse_args(words)
    signals.import_interruptibly("analysis.plots")
    from vehicle_roll_sim.analysis import drawing, pens, plots

    files = [named_file(text, "FILE") for text in arguments.files]
    if len(files) > len(pens.COLOURS):
        wanted = f"at most {len(pens.COLOURS)}, the number of colours"
        raise InputError("FILE", f"{len(files)} files", wanted)
    settings = {"begin": -math.inf, "end": math.inf} | declared_values(arguments, PlotSettings)
    if not settings["begin"] < settings["end"]:
        raise InputError("--end", settings["end"], f"more than --begin, {settings['begin']:g}")
    size = figure_size.named_size(arguments.size, "--size")
    output, labels = _output(arguments.output, files), _labels(arguments.label, files)
    rollover_angle = math.radians(settings.get("stop_roll", DEFAULT_ROLLOVER_DEGREES))
    runs = []
    for file, label in zip(files, labels, strict=True):
        history = history_from(file, arguments.namespace)
        part = part_of(history, settings["begin"], settings["end"], file)
        runs.append(plots.DrawnRun(part, events_of(history, rollover_angle), label))
    title = arguments.title
    if len(runs) == 1:  # no legend needed
        title = labels[0] if title is None else title
        runs = [dataclasses.replace(runs[0], label="")]
    drawing.save_figure(plots.standard_figure(runs, title or "", size), output)
    print(line("plot", output))
    return 0


def history_from(path: Path, namespace: str | None) -> History:
    """The samples of a recorded run; raises InputError if `path` is neither a CSV nor a bag."""
    if path.is_dir():
        need_library("FILE")
        with signals.exit_on_signal():
            from vehicle_roll_sim.bags.reading import last_history  # its library is optional

        return last_history(path, namespace)
    return History.read_csv(path)


def part_of(history: History, begin: float, end: float, path: Path) -> History:
    """The samples from `begin` to `end` (s); raises InputError if there are none."""
    time = history["time"]
    part = history.part((begin <= time) & (time <= end))
    if not len(part.rows):
        field, value = ("--begin", begin) if begin > time[0] else ("--end", end)
        raise InputError(field, value, f"samples of {path}, {time[0]:g} to {time[-1]:g} s")
    return part


def _parser(program: str) -> argparse.ArgumentParser:
    parser = OneLineParser(prog=program, description=COMMANDS["plot"])
    parser.add_argument(
        "files",
        metavar="FILE",
        nargs="+",
        help="a CSV file written by `run --csv`, or a bag; several are overlaid",
    )
    parser.add_argument(
        "--namespace", metavar="NS", help="namespace of the vehicle, if the bag has several"
    )
    add_declared(parser, PlotSettings, "range")
    group = parser.add_argument_group("results")
    group.add_argument(
        "--output",
        metavar="FILE",
        help="figure to write: PNG, SVG or PDF (default for a single run: its name with .png)",
    )
    group.add_argument("--size", metavar="WIDTHxHEIGHT", help=figure_size.HELP)
    group.add_argument(
        "--title",
        metavar="TEXT",
        help="title of the figure (default for a single run: its name)",
    )
    group.add_argument(
        "--label",
        metavar="TEXT",
        action="append",
        help="label of a run; give it once for each run, in the same order",
    )
    return parser


def _output(given: str | None, files: list[Path]) -> Path:
    """Where the figure goes; checked to be writable and not one of the input files."""
    output = named_file(given, "--output")
    if output is None:
        if len(files) > 1:
            raise InputError("--output", None, "the file for a figure of several runs")
        output = files[0].parent / f"{_name(files[0])}.png"
    check_figure_format(output, "--output")
    check_writable(output, "--output")
    if any(output.exists() and file.exists() and output.samefile(file) for file in files):
        raise InputError("--output", str(output), "another file than that of a run")
    return output


def _labels(given: list[str] | None, files: list[Path]) -> list[str]:
    """The labels of the runs: those given, else the names of their files."""
    if given is None:
        names = [_name(file) for file in files]
        return names if len(set(names)) == len(names) else [str(file) for file in files]
    if len(given) != len(files):
        raise InputError("--label", f"{len(given)} labels", f"one for each of {len(files)} files")
    return given


def _name(path: Path) -> str:
    """The name of a file or folder without its suffix."""
    return Path(os.path.abspath(path)).stem
