"""`vehicle_roll_sim replay`: simulate a recorded run again and compare the results."""

import argparse
import math

from vehicle_roll_sim.arguments import OneLineParser, named_file
from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.command_line.vehicle_options import (
    add_simulation_options,
    chosen_simulation,
)
from vehicle_roll_sim.offline.replaying import replays
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.description import MACHINE, VERSION, Described
from vehicle_roll_sim.simulation.simulation import Simulation

INEXACT = 1
"""Exit status with --strict when a run was not reproduced completely and bit for bit."""
NOT_OF_SIMULATION = ("bag", "namespace", "strict")
"""Options that do not describe the simulation."""


def replay_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    arguments = _parser(program).parse_args(words)
    folder = named_file(arguments.bag, "BAG")
    need_library("BAG")
    signals.import_interruptibly("bags.reading", "bags.replay")
    told = _told(arguments)
    if told is None:
        with signals.exit_on_signal():
            compile_model()
    results = []
    for number, run in enumerate(replays(folder, arguments.namespace, told), 1):
        verdict = f"not replayed: the recording starts in mid-run, at {run.begin:.3f} s"
        if run.replay is not None:
            results.append(run)
            _print_versions(run.recorded)
            verdict = _verdict(run.replay)
        print(line(f"run {number}", verdict))
    is_good = all(run.is_reproduced for run in results)
    return INEXACT if arguments.strict and not is_good else 0


def _parser(program: str) -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=program,
        description=COMMANDS["replay"],
        epilog="The bag normally describes the simulation. Options are needed only if it does not; "
        "otherwise they must agree with it.",
    )
    parser.add_argument(
        "bag", metavar="BAG", help="bag written by `run --bag`, `recorder` or `ros2 bag record`"
    )
    parser.add_argument(
        "--namespace", metavar="NS", help="namespace of the vehicle, if the bag has several"
    )
    parser.add_argument(
        "--strict",
        action="store_true",
        help="exit with status 1 unless every run is complete and reproduced bit for bit",
    )
    add_simulation_options(parser)
    return parser


def _told(arguments: argparse.Namespace) -> Simulation | None:
    """The simulation that the options describe, None if none of them was given."""
    given = {name: value for name, value in vars(arguments).items() if value}
    return chosen_simulation(arguments) if given.keys() - {*NOT_OF_SIMULATION} else None


def _print_versions(recorded: Described | None) -> None:
    """Say so if the recording comes from another version or machine."""
    if recorded is not None and (recorded.version, recorded.machine) != (VERSION, MACHINE):
        print(line("recorded with", f"version {recorded.version} on {recorded.machine}"))
        print(line("replayed with", f"version {VERSION} on {MACHINE}"))


def _verdict(result) -> str:
    """The result of a replay in one line."""
    compared = f"{result.end:.3f} s"
    if not result.periods:
        compared += ", nothing to compare"
    elif result.is_exact:
        compared += ", every state reproduced bit for bit"
    elif math.isinf(result.difference):
        compared += f", but {result.name} is nan at {result.time:.3f} s in only one of the two"
    else:
        compared += (
            f", states differ by at most {result.relative:.2g} of their peak: "
            f"{result.name} by {result.difference:.2g} at {result.time:.3f} s"
        )
    if not math.isnan(result.missing_from):
        compared += f"; messages are missing from {result.missing_from:.3f} s on"
    return compared
