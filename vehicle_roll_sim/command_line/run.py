"""`vehicle_roll_sim run`: a manoeuvre or a command file, offline."""

import argparse
import dataclasses
import math
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

from tqdm import tqdm

from vehicle_roll_sim.analysis import figure_size
from vehicle_roll_sim.arguments import (
    OneLineParser,
    add_declared,
    declared_values,
    named_file,
)
from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.command_line.vehicle_options import (
    add_simulation_options,
    chosen_simulation,
    prepared,
)
from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.command_file import load_commands
from vehicle_roll_sim.manoeuvres.manoeuvre import STANDARD, Manoeuvre, manoeuvre_named
from vehicle_roll_sim.model.advance import NANOSECONDS
from vehicle_roll_sim.model.events import Condition
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.history import WITH_COMMANDS, History, check_with_commands
from vehicle_roll_sim.simulation.output_file import (
    check_distinct,
    check_figure_format,
    check_new_folder,
    check_writable,
)
from vehicle_roll_sim.simulation.run import DEFAULT_SAMPLE, HELD_PERIOD, Witness, run
from vehicle_roll_sim.simulation.simulation import (
    SHORTEST_STEP,
    Simulation,
    whole_steps,
)
from vehicle_roll_sim.simulation.summary import line, summary_lines

DESCRIPTION = "Simulate a manoeuvre offline and print what happened."
DIVERGED = 1
"""Exit status of a run that did not stay plausible."""


@dataclasses.dataclass(frozen=True)
class Sampling:
    """When a run is looked at, and when commands are."""

    sample: float = parameter(
        "interval of the rows", "s", SHORTEST_STEP, 1e3, default=DEFAULT_SAMPLE
    )
    command_period: float = parameter(
        "sample commands at this interval and hold them, as a node does; 0: at every "
        "stage, or every 10 ms where they depend on the state",
        "s",
        0.0,
        1e3,
        default=0.0,
    )


def run_command(words: list[str], program: str) -> int:
    """The command, given the words behind its name; returns the exit status."""
    first = _parser(program, None)
    chosen, _ = first.parse_known_args([word for word in words if word not in ("-h", "--help")])
    manoeuvre = _manoeuvre(chosen)
    arguments = _parser(program, manoeuvre).parse_args(words)
    if manoeuvre is None:
        raise InputError("MANOEUVRE", None, "one of " + ", ".join(STANDARD) + ", or --commands")
    sampling = Sampling(**declared_values(arguments, Sampling))
    csv, plot, bag = _results(arguments)
    size = figure_size.named_size(arguments.size, "--size", plot)
    check_with_commands(arguments.with_commands, csv)
    simulation = chosen_simulation(arguments)
    manoeuvre = _adjusted(manoeuvre, arguments, simulation.step_ns)
    _check_multiples(manoeuvre, sampling, simulation.step_ns)
    manoeuvre = prepared(manoeuvre, simulation.vehicle, simulation.options)
    driver = manoeuvre.driver()
    simulation.reset(manoeuvre.speed)
    period = sampling.command_period or HELD_PERIOD
    with _recorded(simulation, manoeuvre.commanded, bag, period) as witness:
        history = _run_with_progress(simulation, driver, manoeuvre.duration, sampling, witness)
    if csv:
        history.write_csv(csv, arguments.with_commands)
    if plot:
        from vehicle_roll_sim.analysis import plots  # half a second, for those who want a figure

        title = arguments.manoeuvre or arguments.commands
        plots.plot_run(history, simulation.events, plot, title, size)
    report = [line(label, text) for label, text in manoeuvre.report(history, driver).items()]
    lines = summary_lines(
        simulation.events, simulation.time, simulation.condition, simulation.implausible
    )
    written = (("CSV", csv), ("plot", plot), ("bag", bag))
    results = [line(label, path) for label, path in written if path]
    print("\n".join([*report, *lines, *results]))
    return DIVERGED if simulation.condition is Condition.DIVERGED else 0


def _parser(program: str, manoeuvre: Manoeuvre | None) -> argparse.ArgumentParser:
    """The parser with the options of `manoeuvre` and its defaults, or with those of all."""
    parser = OneLineParser(prog=program, description=DESCRIPTION)
    parser.add_argument(
        "manoeuvre",
        metavar="MANOEUVRE",
        nargs="?",
        help=", ".join(STANDARD) + "; with its name, --help shows its options",
    )
    parser.add_argument("--commands", metavar="FILE.csv", help="commands instead of a manoeuvre")
    for declaring in [manoeuvre] if manoeuvre else map(type, STANDARD.values()):
        add_declared(parser, declaring, "manoeuvre")
    add_simulation_options(parser)
    add_declared(parser, Sampling, "sampling")
    group = parser.add_argument_group("results")
    group.add_argument("--csv", metavar="FILE", help="write the samples")
    group.add_argument("--with-commands", action="store_true", help=WITH_COMMANDS)
    group.add_argument("--bag", metavar="DIR", help="write what the node would have published")
    group.add_argument("--plot", metavar="FILE", help="draw the run (PNG, SVG or PDF)")
    group.add_argument("--size", metavar="WIDTHxHEIGHT", help=figure_size.HELP)
    return parser


def _check_multiples(manoeuvre: Manoeuvre, sampling: Sampling, step_ns: int) -> None:
    """Times that the run is divided into must be multiples of the step."""
    whole_steps(manoeuvre.duration, step_ns, "--duration")
    whole_steps(sampling.sample, step_ns, "--sample")
    if sampling.command_period:
        whole_steps(sampling.command_period, step_ns, "--command-period")


def _results(arguments: argparse.Namespace) -> tuple[Path | None, ...]:
    """Where CSV, figure and bag go, known to be writable."""
    csv, plot = named_file(arguments.csv, "--csv"), named_file(arguments.plot, "--plot")
    for path, field in ((csv, "--csv"), (plot, "--plot")):
        if path:
            check_writable(path, field)
    if plot:
        check_figure_format(plot, "--plot")
    bag = named_file(arguments.bag, "--bag")
    check_distinct({"--csv": csv, "--plot": plot, "--bag": bag})
    if bag:
        need_library("--bag")
        check_new_folder(bag, "--bag")
    return csv, plot, bag


def _recorded(
    simulation: Simulation, commanded: tuple[str, ...], bag: Path | None, period: float
) -> AbstractContextManager[Witness | None]:
    """The witness that writes the bag, if there is to be one."""
    if bag is None:
        return nullcontext()
    from vehicle_roll_sim.bags.run_bag import run_bag  # its library is optional

    return run_bag(simulation, commanded, bag, round(period * NANOSECONDS), "--bag")


def _manoeuvre(chosen: argparse.Namespace) -> Manoeuvre | None:
    """The manoeuvre or command file that the words name, with its defaults."""
    if chosen.commands is not None and chosen.manoeuvre is not None:
        raise InputError("--commands", chosen.commands, "not together with a manoeuvre")
    if command_file := named_file(chosen.commands, "--commands"):
        return load_commands(command_file)
    return manoeuvre_named(chosen.manoeuvre) if chosen.manoeuvre else None


def _adjusted(manoeuvre: Manoeuvre, arguments: argparse.Namespace, step_ns: int) -> Manoeuvre:
    """The manoeuvre with the values of the command line."""
    values = declared_values(arguments, manoeuvre)
    if arguments.commands and "duration" not in values:
        if not manoeuvre.duration > 0.0:
            raise InputError("--duration", None, "a file that ends at time 0 does not say how long")
        steps = math.ceil(manoeuvre.duration * NANOSECONDS / step_ns - 1e-6)
        values["duration"] = steps * step_ns / NANOSECONDS
    return dataclasses.replace(manoeuvre, **values)


def _run_with_progress(
    simulation: Simulation,
    driver: Programme | Feedback,
    duration: float,
    sampling: Sampling,
    witness: Witness | None,
) -> History:
    """Run, with a progress bar at a terminal when it takes longer than a second."""
    bar_format = "{l_bar}{bar}| {n:.1f}/{total:.1f} s simulated [{elapsed}<{remaining}]"
    with tqdm(total=duration, delay=1.0, disable=None, bar_format=bar_format, leave=False) as bar:
        return run(
            simulation,
            driver,
            duration,
            sample=sampling.sample,
            command_period=sampling.command_period,
            witness=witness,
            progress=bar.update,
        )
