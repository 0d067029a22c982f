"""`vehicle_roll_sim plot`: the standard figure of one recorded run, or of several overlaid."""

import argparse
import dataclasses
import math

from vehicle_roll_sim.analysis import figure_size
from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.command_line import signals
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
from vehicle_roll_sim.files.output_file import check_figure_format
from vehicle_roll_sim.runs.sampled_events import events_of
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_DEGREES


def plot_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    arguments = _parser(program).parse_args(words)
    signals.import_interruptibly("analysis.plots")
    from vehicle_roll_sim.analysis import drawing, pens, plots

    files = files_of(arguments, "FILE", len(pens.COLOURS), "the number of colours")
    settings = part_settings(arguments)
    size = figure_size.named_size(arguments.size, "--size")
    output = output_of(arguments.output, "--output", ".png", files)
    check_figure_format(output, "--output")
    check_output(output, "--output", files)
    labels = labels_of(arguments.label, files)
    rollover_angle = math.radians(settings.get("stop_roll", DEFAULT_ROLLOVER_DEGREES))
    runs = []
    for file, label in zip(files, labels, strict=True):
        history, simulation = run_from(file, arguments.namespace, "FILE")
        part = part_of(history, settings, file)
        road = simulation.road if simulation else None
        runs.append(plots.DrawnRun(part, events_of(history, rollover_angle), label, road))
    title = arguments.title
    if len(runs) == 1:  # no legend needed
        title = labels[0] if title is None else title
        runs = [dataclasses.replace(runs[0], label="")]
    drawing.save_figure(plots.standard_figure(runs, title or "", size), output)
    print(line("plot", output))
    return 0


def _parser(program: str) -> argparse.ArgumentParser:
    parser = OneLineParser(prog=program, description=COMMANDS["plot"])
    add_runs(parser, "FILE")
    group = parser.add_argument_group("results")
    group.add_argument(
        "--output",
        metavar="FILE",
        help="figure to write: PNG, SVG or PDF (default for a single run: its name with .png)",
    )
    group.add_argument("--size", metavar="WIDTHxHEIGHT", help=figure_size.HELP)
    add_names(group, "figure", "for a single run its name")
    return parser
