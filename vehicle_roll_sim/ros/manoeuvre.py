"""The node `manoeuvre`: resets a running simulator and drives it through a manoeuvre."""

import argparse
import dataclasses
import sys
from pathlib import Path

from vehicle_roll_sim.analysis.sampled_events import events_of
from vehicle_roll_sim.arguments import (
    OneLineParser,
    add_declared,
    declared_values,
    named_file,
)
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.manoeuvres.manoeuvre import STANDARD, Manoeuvre, manoeuvre_named
from vehicle_roll_sim.model.events import Condition
from vehicle_roll_sim.ros import ending
from vehicle_roll_sim.ros.driver import ROUNDING, Driver
from vehicle_roll_sim.ros.process import lifetime, node_main
from vehicle_roll_sim.ros.simulator_client import NoAnswerError, SimulatorClient
from vehicle_roll_sim.simulation.history import History
from vehicle_roll_sim.simulation.output_file import (
    check_distinct,
    check_figure_format,
    check_writable,
)
from vehicle_roll_sim.simulation.summary import line, summary_lines

NO_SIMULATOR = 1
"""Exit status when none does."""
DIVERGED = 1
"""Exit status when the model of the simulator did not stay plausible."""


def late_commands(history: History, sent_at: dict[float, float]) -> int:
    """Periods whose steering (rad) is not the one that was sent at their beginning (s)."""
    driven = zip(history["time"][:-1].tolist(), history["steering"][1:], strict=True)
    return sum(abs(found - sent_at.get(time, found)) > ROUNDING for time, found in driven)


def drive(
    name: str, manoeuvre: Manoeuvre, simulator: str, csv: Path | None, plot: Path | None
) -> int:
    """Play the manoeuvre, then tell of it; the exit status."""
    driver = Driver(manoeuvre)
    try:
        with lifetime(driver) as executor:
            driver.prepare(SimulatorClient(driver, executor, simulator))
            driver.play()
        with ending.interruptible():
            return _tell(name, driver, csv, plot)
    except NoAnswerError as error:
        print(f"manoeuvre: error: {error}", file=sys.stderr)
        return NO_SIMULATOR


def _tell(name: str, driver: Driver, csv: Path | None, plot: Path | None) -> int:
    """Write the files of a manoeuvre that was played and print its summary; the exit status.

    Raises NoAnswerError if there is nothing to tell of.
    """
    history = driver.collector.history(driver.road)
    if not len(history.rows):
        raise NoAnswerError("no whole set came from the simulator")
    events = events_of(history, driver.rollover_angle)
    if csv:
        history.write_csv(csv)
    if plot:
        from vehicle_roll_sim.analysis import plots  # half a second, for those who want a figure

        plots.plot_run(history, events, plot, name)
    condition = driver.condition
    late = late_commands(history, driver.sent)
    report = driver.manoeuvre.report(history, driver.driver)
    lines = summary_lines(events, history["time"][-1], condition, "its state")
    print("\n".join([*(line(label, text) for label, text in report.items()), *lines]))
    if late:
        print(line("late commands", f"{late} periods were driven with an older command"))
    for label, path in (("CSV", csv), ("plot", plot)):
        if path:
            print(line(label, path))
    return DIVERGED if condition is Condition.DIVERGED else 0


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog="manoeuvre",
        description="Drive a running simulator through a manoeuvre and print what happened.",
    )
    parser.add_argument("manoeuvre", metavar="NAME", help=", ".join(STANDARD))
    for declaring in map(type, STANDARD.values()):
        add_declared(parser, declaring, "manoeuvre")
    parser.add_argument(
        "--simulator", default="simulator", metavar="NODE", help="name of the simulator's node"
    )
    parser.add_argument("--csv", metavar="FILE", help="write a row for every set that came")
    parser.add_argument("--plot", metavar="FILE", help="draw the run (PNG, SVG or PDF)")
    return parser


def main() -> int:
    """Entry point of the executable."""

    def body(arguments: argparse.Namespace) -> int:
        manoeuvre = manoeuvre_named(arguments.manoeuvre)
        manoeuvre = dataclasses.replace(manoeuvre, **declared_values(arguments, manoeuvre))
        if not arguments.simulator:
            raise InputError("--simulator", "", "the name of a node")
        csv, plot = named_file(arguments.csv, "--csv"), named_file(arguments.plot, "--plot")
        for path, option in ((csv, "--csv"), (plot, "--plot")):
            if path:
                check_writable(path, option)
        if plot:
            check_figure_format(plot, "--plot")
        check_distinct({"--csv": csv, "--plot": plot})
        return drive(arguments.manoeuvre, manoeuvre, arguments.simulator, csv, plot)

    return node_main(_parser(), body, sys.argv)


if __name__ == "__main__":
    sys.exit(main())
