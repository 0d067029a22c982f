"""The node `manoeuvre`: resets a running simulator and drives it through a manoeuvre."""

import argparse
import dataclasses
import sys
from pathlib import Path

from vehicle_roll_sim.analysis import figure_size
from vehicle_roll_sim.arguments import (
    OneLineParser,
    add_declared,
    declared_values,
    named_file,
)
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import (
    check_distinct,
    check_figure_format,
    check_writable,
)
from vehicle_roll_sim.manoeuvres.catalogue import ON_ANY_ROAD, Manoeuvre, manoeuvre_named
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.ros import signals
from vehicle_roll_sim.ros.clients.manoeuvre_player import ROUNDING, ManoeuvrePlayer
from vehicle_roll_sim.ros.clients.simulator_client import NoAnswerError, SimulatorClient
from vehicle_roll_sim.ros.node_main import lifetime, node_main
from vehicle_roll_sim.runs.history import WITH_COMMANDS, WITH_SIGNALS, History, check_with_csv
from vehicle_roll_sim.runs.sampled_events import events_of
from vehicle_roll_sim.runs.summary import line, summary_lines

NO_SIMULATOR = 1
"""Exit status if no simulator answers as it should."""
DIVERGED = 1
"""Exit status if the simulator's model diverged."""


def late_commands(history: History, sent_at: dict[float, float]) -> int:
    """The number of periods that ran with another steering than was sent for them.

    sent_at: steering commands (rad) by the time (s) at which their period begins.
    """
    driven = zip(history["time"][:-1].tolist(), history["steering"][1:], strict=True)
    return sum(abs(found - sent_at.get(time, found)) > ROUNDING for time, found in driven)


@dataclasses.dataclass(frozen=True)
class Files:
    """The files to write: CSV, with or without further columns, and figure, with its size."""

    csv: Path | None
    plot: Path | None
    with_commands: bool = False
    with_signals: bool = False
    size: figure_size.Size | None = None


def drive(name: str, manoeuvre: Manoeuvre, simulator: str, files: Files) -> int:
    """Play the manoeuvre, write its files and print its summary; return the exit status."""
    driver = ManoeuvrePlayer(manoeuvre)
    try:
        with lifetime(driver) as executor:
            driver.prepare(SimulatorClient(driver, executor, simulator))
            driver.play()
        with signals.interruptible():
            return _tell(name, driver, files)
    except NoAnswerError as error:
        print(f"manoeuvre: error: {error}", file=sys.stderr)
        return NO_SIMULATOR


def _tell(name: str, driver: ManoeuvrePlayer, files: Files) -> int:
    """Write the files of a completed manoeuvre and print its summary; return the exit status.

    Raises NoAnswerError if no complete set was received.
    """
    history = driver.collector.history(driver.road)
    if not len(history.rows):
        raise NoAnswerError("the simulator sent no complete set of messages")
    events = events_of(history, driver.rollover_angle)
    if files.csv:
        history.write_csv(files.csv, files.with_commands, files.with_signals)
    if files.plot:
        from vehicle_roll_sim.analysis import plots  # takes 0.5 s: only if a figure is wanted

        plots.plot_run(history, events, files.plot, name, files.size, driver.road)
    condition = driver.condition
    late = late_commands(history, driver.sent)
    report = driver.manoeuvre.results(history, driver.driver)
    lines = summary_lines(events, history["time"][-1], condition, "its state")
    print("\n".join([*(line(label, text) for label, text in report.items()), *lines]))
    if late:
        print(line("late commands", f"{late} periods ran with an older command"))
    for label, path in (("CSV", files.csv), ("plot", files.plot)):
        if path:
            print(line(label, path))
    return DIVERGED if condition is Condition.DIVERGED else 0


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog="manoeuvre",
        description="Drive a running simulator through a manoeuvre and print a summary.",
    )
    parser.add_argument("manoeuvre", metavar="NAME", help=", ".join(ON_ANY_ROAD))
    for declaring in map(type, ON_ANY_ROAD.values()):
        add_declared(parser, declaring, "manoeuvre")
    parser.add_argument(
        "--simulator",
        default="simulator",
        metavar="NODE",
        help="name of the simulator node (default: %(default)s)",
    )
    parser.add_argument("--csv", metavar="FILE", help="write a CSV row for each set received")
    parser.add_argument("--with-commands", action="store_true", help=WITH_COMMANDS)
    parser.add_argument("--with-signals", action="store_true", help=WITH_SIGNALS)
    parser.add_argument("--plot", metavar="FILE", help="plot the run (PNG, SVG or PDF)")
    parser.add_argument("--size", metavar="WIDTHxHEIGHT", help=figure_size.HELP)
    return parser


def main() -> int:
    """Entry point of the executable."""

    def body(arguments: argparse.Namespace) -> int:
        manoeuvre = manoeuvre_named(arguments.manoeuvre)
        manoeuvre = manoeuvre.with_values(declared_values(arguments, manoeuvre))
        if not arguments.simulator:
            raise InputError("--simulator", "", "the name of a node")
        csv, plot = named_file(arguments.csv, "--csv"), named_file(arguments.plot, "--plot")
        for path, option in ((csv, "--csv"), (plot, "--plot")):
            if path:
                check_writable(path, option)
        if plot:
            check_figure_format(plot, "--plot")
        check_distinct({"--csv": csv, "--plot": plot})
        size = figure_size.named_size(arguments.size, "--size", plot)
        check_with_csv("--with-commands", arguments.with_commands, csv)
        check_with_csv("--with-signals", arguments.with_signals, csv)
        files = Files(csv, plot, arguments.with_commands, arguments.with_signals, size)
        return drive(arguments.manoeuvre, manoeuvre, arguments.simulator, files)

    return node_main(_parser(), body, sys.argv)


if __name__ == "__main__":
    sys.exit(main())
