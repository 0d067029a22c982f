"""`vehicle_roll_sim run`: simulate a manoeuvre or a command file offline."""

import argparse
import dataclasses
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
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.plausibility_option import warn_or_refuse
from vehicle_roll_sim.command_line.vehicle_options import (
    add_simulation_options,
    as_option,
    chosen_simulation,
)
from vehicle_roll_sim.declaration import InputError, parameter, parameters_of
from vehicle_roll_sim.files.output_file import (
    check_distinct,
    check_figure_format,
    check_new_folder,
    check_page_format,
    check_writable,
)
from vehicle_roll_sim.manoeuvres.base import OpenLoop
from vehicle_roll_sim.manoeuvres.catalogue import MANOEUVRES, Manoeuvre, manoeuvre_named
from vehicle_roll_sim.manoeuvres.command_file import load_commands
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.offline.manoeuvre_argument import manoeuvre_of
from vehicle_roll_sim.offline.run_result import RunResult
from vehicle_roll_sim.offline.running import drive
from vehicle_roll_sim.runs.history import WITH_COMMANDS, WITH_SIGNALS, check_with_csv
from vehicle_roll_sim.runs.run import DEFAULT_SAMPLE, HELD_PERIOD
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.limits import SHORTEST_STEP
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.viewer.page import write_page
from vehicle_roll_sim.viewer.recording import ViewedRun
from vehicle_roll_sim.viewer.scene import scene_of

HELD_BY_BAG = (
    f"held for {HELD_PERIOD:g} s each, as in a node; "
    f"without --bag, --command-period {HELD_PERIOD:g} gives the same run"
)
"""Note on how --bag changes a run whose commands are otherwise evaluated at every stage."""
DIVERGED = 1
"""Exit status of a run that diverged."""


@dataclasses.dataclass(frozen=True)
class Sampling:
    """How often the run is sampled, and how often its commands are evaluated."""

    sample: float = parameter(
        "interval between samples", "s", SHORTEST_STEP, 1e3, default=DEFAULT_SAMPLE
    )
    command_period: float = parameter(
        "evaluate commands at this interval and hold them in between, as a node does; 0: at every "
        "stage of the integration, or every 10 ms if they depend on the state",
        "s",
        0.0,
        1e3,
        default=0.0,
    )


def run_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    first = _parser(program, None)
    chosen, _ = first.parse_known_args([word for word in words if word not in ("-h", "--help")])
    manoeuvre = _manoeuvre(chosen)
    arguments = _parser(program, manoeuvre).parse_args(words)
    if manoeuvre is None:
        raise InputError("MANOEUVRE", None, "one of " + ", ".join(MANOEUVRES) + ", or --commands")
    sampling = Sampling(**declared_values(arguments, Sampling))
    csv, plot, bag = _results(arguments)
    view = _page(arguments, csv, plot, bag)
    size = figure_size.named_size(arguments.size, "--size", plot)
    check_with_csv("--with-commands", arguments.with_commands, csv)
    check_with_csv("--with-signals", arguments.with_signals, csv)
    if plot:
        signals.import_interruptibly("analysis.plots")
    if bag:
        signals.import_interruptibly("bags.run_bag")
    warn_or_refuse(manoeuvre.doubts, arguments)
    values = declared_values(arguments, manoeuvre)
    simulation = chosen_simulation(arguments, _with_values(manoeuvre, values))
    try:
        manoeuvre = manoeuvre_of(manoeuvre, values, simulation.step_ns)
        result = _run_with_progress(manoeuvre, simulation, sampling, bag, arguments.stamped)
    except InputError as error:
        if error.field in {*parameters_of(manoeuvre), *parameters_of(Sampling), "bag"}:
            raise as_option(error) from None
        raise
    if csv:
        result.write_csv(csv, arguments.with_commands, arguments.with_signals)
    if plot:
        result.plot(plot, arguments.manoeuvre or arguments.commands, size)
    if view:
        _write_page(view, result, simulation, arguments.manoeuvre or arguments.commands)
    is_held_by_bag = bag and not sampling.command_period and isinstance(result.manoeuvre, OpenLoop)
    notes = [line("commands", HELD_BY_BAG)] if is_held_by_bag else []
    written = (("CSV", csv), ("plot", plot), ("page", view), ("bag", bag))
    results = [line(label, path) for label, path in written if path]
    print("\n".join([result.summary, *notes, *results]))
    return DIVERGED if result.condition is Condition.DIVERGED else 0


def _parser(program: str, manoeuvre: Manoeuvre | None) -> argparse.ArgumentParser:
    """The parser with the options and defaults of `manoeuvre`, or with the options of all."""
    parser = OneLineParser(prog=program, description=COMMANDS["run"])
    parser.add_argument(
        "manoeuvre",
        metavar="MANOEUVRE",
        nargs="?",
        help=", ".join(MANOEUVRES) + "; `run NAME --help` shows the options of one",
    )
    parser.add_argument(
        "--commands", metavar="FILE.csv", help="drive by a command file instead of a manoeuvre"
    )
    for declaring in [manoeuvre] if manoeuvre else map(type, MANOEUVRES.values()):
        add_declared(parser, declaring, "manoeuvre")
    add_simulation_options(parser)
    add_declared(parser, Sampling, "sampling")
    group = parser.add_argument_group("results")
    group.add_argument("--csv", metavar="FILE", help="write the samples to a CSV file")
    group.add_argument("--with-commands", action="store_true", help=WITH_COMMANDS)
    group.add_argument("--with-signals", action="store_true", help=WITH_SIGNALS)
    group.add_argument(
        "--bag",
        metavar="DIR",
        help="write a bag of what the node would have published; commands are then held for "
        "10 ms as in the node (--command-period), which changes the run",
    )
    about = "in the bag, add a NAME_stamped topic for each without a header (see publish_stamped)"
    group.add_argument("--stamped", action="store_true", help=about)
    group.add_argument("--plot", metavar="FILE", help="plot the run (PNG, SVG or PDF)")
    group.add_argument("--size", metavar="WIDTHxHEIGHT", help=figure_size.HELP)
    about = "write a page (HTML) that shows the run in a browser, as `view` does"
    group.add_argument("--view", metavar="FILE", help=about)
    return parser


def _results(arguments: argparse.Namespace) -> tuple[Path | None, ...]:
    """Where the CSV file, figure and bag go; checked to be writable."""
    csv, plot = named_file(arguments.csv, "--csv"), named_file(arguments.plot, "--plot")
    for path, field in ((csv, "--csv"), (plot, "--plot")):
        if path:
            check_writable(path, field)
    if plot:
        check_figure_format(plot, "--plot")
    bag = named_file(arguments.bag, "--bag")
    check_distinct({"--csv": csv, "--plot": plot, "--bag": bag})
    if arguments.stamped and not bag:
        raise InputError("--stamped", "", "together with --bag", "there is no bag")
    if bag:
        need_library("--bag")
        check_new_folder(bag, "--bag")
    return csv, plot, bag


def _page(arguments: argparse.Namespace, *others: Path | None) -> Path | None:
    """Where the page goes; checked to be writable and different from the other results."""
    page = named_file(arguments.view, "--view")
    if page:
        check_page_format(page, "--view")
        check_writable(page, "--view")
        names = ("--csv", "--plot", "--bag")
        check_distinct(dict(zip(names, others, strict=True)) | {"--view": page})
    return page


def _write_page(path: Path, result: RunResult, simulation: Simulation, title: str) -> None:
    scene = scene_of(simulation.vehicle, simulation.options)
    run = ViewedRun(result.history, result.events, title, scene, simulation.road)
    write_page(path, [run], title, getattr(result.manoeuvre, "cones", ()))


def _manoeuvre(chosen: argparse.Namespace) -> Manoeuvre | None:
    """The chosen manoeuvre, with its defaults, or command file; None if neither was given."""
    if chosen.commands is not None and chosen.manoeuvre is not None:
        raise InputError("--commands", chosen.commands, "not together with a manoeuvre")
    if command_file := named_file(chosen.commands, "--commands"):
        return load_commands(command_file)
    return manoeuvre_named(chosen.manoeuvre, MANOEUVRES) if chosen.manoeuvre else None


def _with_values(manoeuvre: Manoeuvre, values: dict) -> Manoeuvre:
    try:
        return manoeuvre.with_values(values)
    except InputError as error:
        raise as_option(error) from None


def _run_with_progress(
    manoeuvre: Manoeuvre,
    simulation: Simulation,
    sampling: Sampling,
    bag: Path | None,
    stamped: bool,
) -> RunResult:
    """Run, with a progress bar on a terminal if it takes longer than a second."""
    bar_format = "{l_bar}{bar}| {n:.1f}/{total:.1f} s simulated [{elapsed}<{remaining}]"
    about = {"delay": 1.0, "disable": None, "bar_format": bar_format, "leave": False}
    with tqdm(total=manoeuvre.duration, **about) as bar:
        return drive(
            manoeuvre,
            simulation,
            sample=sampling.sample,
            command_period=sampling.command_period,
            bag=bag,
            stamped=stamped,
            progress=bar.update,
        )
