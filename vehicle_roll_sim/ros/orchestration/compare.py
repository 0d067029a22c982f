"""The executable `compare`: a manoeuvre without and with your controller, side by side."""

import argparse
import os
import signal
import sys
from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

from vehicle_roll_sim.analysis import figure_size
from vehicle_roll_sim.arguments import (
    OneLineParser,
    add_declared,
    declared_values,
    exit_status,
    named_file,
    option_name,
)
from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.files.output_file import (
    check_distinct,
    check_figure_format,
    check_writable,
)
from vehicle_roll_sim.live.channels import channels
from vehicle_roll_sim.manoeuvres.catalogue import ON_ANY_ROAD, Manoeuvre, manoeuvre_named
from vehicle_roll_sim.ros.controller_scripts import assigned, commanded_by, scripts_of
from vehicle_roll_sim.ros.orchestration.comparison import (
    Chain,
    Outcome,
    RunFailedError,
    Scenario,
    drive,
)
from vehicle_roll_sim.ros.orchestration.comparison_table import WITHOUT, comparison_table
from vehicle_roll_sim.ros.orchestration.demo import LOCAL
from vehicle_roll_sim.ros.orchestration.domains import own_domain
from vehicle_roll_sim.ros.simulator.settings import COMMANDED
from vehicle_roll_sim.runs.sampled_events import events_of
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.compilation import compile_model

DESCRIPTION = "Drive a manoeuvre in lockstep without and with controllers, and compare the runs."
LARGEST_DOMAIN = 232
"""The largest ROS domain ID."""
SET_HERE = ("mode", "lockstep_topics")
"""Parameters of the simulator that this program sets itself."""


def scenario_of(arguments: argparse.Namespace) -> Scenario:
    """The manoeuvre and the simulator that the arguments describe; raises InputError."""
    manoeuvre = manoeuvre_named(arguments.manoeuvre)
    values = declared_values(arguments, manoeuvre)
    manoeuvre = manoeuvre.with_values(values)
    words = [arguments.manoeuvre]
    for name, value in values.items():
        option = option_name(parameters_of(manoeuvre)[name])
        words += [option] if value is True else [option, str(value)]
    parameters = [assignment(each, "--simulator") for each in arguments.simulator]
    for each in parameters:
        name = each.partition(":=")[0]
        if name in SET_HERE:
            raise InputError("--simulator", each, f"any parameter but {' and '.join(SET_HERE)}")
    return Scenario(tuple(words), _commands_of(manoeuvre), tuple(parameters))


def _commands_of(manoeuvre: Manoeuvre) -> tuple[str, ...]:
    commanded = {name: each.field in manoeuvre.commanded for name, each in channels().items()}
    return tuple(name for name in COMMANDED if commanded[name])


def assignment(text: str, option: str) -> str:
    name, sign, value = text.partition(":=")
    if not (name and sign and value):
        raise InputError(option, text, "NAME:=VALUE")
    return text


def chain_of(arguments: argparse.Namespace) -> Chain:
    """The controllers that the arguments describe; raises InputError."""
    scripts = scripts_of(arguments.scripts, "SCRIPT")
    commands = tuple(arguments.answers or commanded_by(scripts, "SCRIPT"))
    for name in commands:
        if name not in COMMANDED:
            raise InputError("--answers", name, "one of " + ", ".join(COMMANDED))
    if not commands:
        wanted = "a script whose `said` names a command topic, or --answers TOPIC"
        raise InputError("SCRIPT", " ".join(arguments.scripts), wanted, "publishes no command")
    given = [assignment(each, "--parameter") for each in arguments.parameter]
    words = assigned(given, scripts, "SCRIPT")
    return Chain(
        commands, tuple((str(each.resolve()), *_ros_words(words[each])) for each in scripts)
    )


def _ros_words(parameters: Sequence[str]) -> list[str]:
    return ["--ros-args", *parameters] if parameters else []


def compare(arguments: argparse.Namespace) -> list[str]:
    """Check the arguments, drive both runs and write the files; return the lines to print."""
    scenario, chain = scenario_of(arguments), chain_of(arguments)
    plot = named_file(arguments.plot, "--plot")
    size = figure_size.named_size(arguments.size, "--size", plot)
    files = {"--plot": plot, **_csv_files(arguments.csv)}
    for option, file in files.items():
        if file:
            check_writable(file, option.partition(" ")[0])
    if plot:
        check_figure_format(plot, "--plot")
    check_distinct(files)
    name = " + ".join(Path(each).stem for each in arguments.scripts)
    with domain_of(arguments.domain) as domain:
        os.environ.update(LOCAL | {"ROS_DOMAIN_ID": str(domain)})
        compile_model()
        found = drive(scenario, chain)  # first, since it is the one that may fail
        without = drive(scenario)
    for run, file in zip((without, found), list(files.values())[1:], strict=False):
        run.history.write_csv(file, with_commands=True)
    if plot:
        _draw({WITHOUT: without, name: found}, arguments.manoeuvre, plot, size)
    written = [line(option.strip("-"), file) for option, file in files.items() if file]
    return [*comparison_table(without, found, name), *written]


def _csv_files(given: list[str] | None) -> dict[str, Path]:
    kinds = (WITHOUT, "with")
    texts = zip(kinds, given, strict=True) if given else ()
    return {f"--csv {kind}": named_file(text, "--csv") for kind, text in texts}


def domain_of(given: str | None) -> AbstractContextManager[int]:
    """The ROS domain given, else one that nobody else uses; raises InputError."""
    if given is None:
        return own_domain()
    if not (given.isascii() and given.isdecimal() and int(given) <= LARGEST_DOMAIN):
        raise InputError("--domain", given, f"a whole number from 0 to {LARGEST_DOMAIN}")
    return nullcontext(int(given))


def _draw(runs: dict[str, Outcome], title: str, path: Path, size: figure_size.Size | None) -> None:
    from vehicle_roll_sim.analysis import drawing, plots  # takes 0.5 s: only if a figure is wanted

    drawn = [
        plots.DrawnRun(run.history, events_of(run.history, run.rollover_angle), name)
        for name, run in runs.items()
    ]
    drawing.save_figure(plots.standard_figure(drawn, title, size), path)


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(prog="compare", description=DESCRIPTION)
    parser.add_argument(
        "scripts",
        metavar="SCRIPT",
        nargs="+",
        help="path of a controller script, or the name of an example",
    )
    parser.add_argument(
        "--manoeuvre",
        metavar="NAME",
        default="j_turn",
        help=f"{', '.join(ON_ANY_ROAD)} (default: %(default)s)",
    )
    for declaring in map(type, ON_ANY_ROAD.values()):
        add_declared(parser, declaring, "manoeuvre")
    group = parser.add_argument_group("nodes")
    assignment = {"metavar": "NAME:=VALUE", "action": "append", "default": []}
    group.add_argument(
        "--parameter", **assignment, help="set a parameter of the controllers; repeatable"
    )
    group.add_argument(
        "--simulator",
        **assignment,
        help="set a parameter of the simulator, such as vehicle.cg_height:=0.62; repeatable",
    )
    group.add_argument(
        "--answers",
        metavar="TOPIC",
        nargs="+",
        help="command topics of the controllers (default: those declared as `said`)",
    )
    group.add_argument(
        "--domain", metavar="N", help="ROS domain ID to use (default: one that nobody else uses)"
    )
    group = parser.add_argument_group("results")
    group.add_argument("--plot", metavar="FILE", help="plot both runs (PNG, SVG or PDF)")
    group.add_argument("--size", metavar="WIDTHxHEIGHT", help=figure_size.HELP)
    group.add_argument(
        "--csv",
        metavar=("WITHOUT", "WITH"),
        nargs=2,
        help="write the samples of both runs, without and with controllers",
    )
    return parser


def main() -> int:
    """Entry point of the executable."""
    parser = _parser()

    def command() -> int:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        try:
            print("\n".join(compare(parser.parse_args())))
        except RunFailedError as error:
            print(f"{parser.prog}: error: {error}", file=sys.stderr)
            return error.status
        return 0

    return exit_status(command, parser.prog)


if __name__ == "__main__":
    sys.exit(main())
