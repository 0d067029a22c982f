"""`vehicle_roll_sim replay`: a recorded run simulated again, and how exactly it comes out."""

import argparse
import math
from pathlib import Path

from vehicle_roll_sim.arguments import OneLineParser, named_file
from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.command_line import ending
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.command_line.vehicle_options import (
    add_simulation_options,
    chosen_simulation,
)
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.simulation.description import MACHINE, VERSION, described, difference
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.simulation.summary import line

DESCRIPTION = "Simulate the runs in a bag again, on the commands that were applied, and compare."
INEXACT = 1
"""Exit status with --strict when a run was not wholly reproduced to the bit."""
NOT_OF_SIMULATION = ("bag", "namespace", "strict")
"""Options that do not say what is simulated."""


def replay_command(words: list[str], program: str) -> int:
    """The command, given the words behind its name; returns the exit status."""
    arguments = _parser(program).parse_args(words)
    folder = named_file(arguments.bag, "BAG")
    need_library("BAG")
    from vehicle_roll_sim.bags.reading import recorded_runs  # their library is optional
    from vehicle_roll_sim.bags.replay import replay

    told = _told(arguments)
    runs = recorded_runs(folder, arguments.namespace)
    if told is None:
        with ending.at_once():
            compile_model()
    if not any(run.begins_at_a_reset for run in runs):
        allowed = "a recording of at least one run from its reset on, time 0"
        raise InputError("BAG", str(folder), allowed, f"{folder}: it begins under way")
    results = []
    for number, run in enumerate(runs, 1):
        verdict = f"under way already at {run.states[0]['time']:.3f} s: not replayed"
        if run.begins_at_a_reset:
            results.append(replay(run, *_simulation(run.description, told, folder)))
            verdict = _verdict(results[-1])
        print(line(f"run {number}", verdict))
    is_good = all(result.is_exact and result.is_complete for result in results)
    return INEXACT if arguments.strict and not is_good else 0


def _parser(program: str) -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=program,
        description=DESCRIPTION,
        epilog="A bag says itself what was simulated. Options that say it too must agree with it.",
    )
    parser.add_argument("bag", metavar="BAG", help="of `run --bag`, recorder or ros2 bag record")
    parser.add_argument("--namespace", metavar="NS", help="vehicle, if the bag has several")
    parser.add_argument(
        "--strict", action="store_true", help="status 1 unless it is whole and exact to the bit"
    )
    add_simulation_options(parser)
    return parser


def _told(arguments: argparse.Namespace) -> Simulation | None:
    """What the options describe, None if there are none."""
    given = {name: value for name, value in vars(arguments).items() if value}
    return chosen_simulation(arguments) if given.keys() - {*NOT_OF_SIMULATION} else None


def _simulation(
    description: str, told: Simulation | None, folder: Path
) -> tuple[Simulation, float | None]:
    """What was recorded, and its publish period (s) where the bag says it.

    Raises InputError where bag and options do not agree.
    """
    if not description:
        if told is None:
            allowed = "options that say what was simulated, as in `run`"
            raise InputError("BAG", str(folder), allowed, f"{folder} does not say it")
        return told, None
    recorded = described(description)
    if (recorded.version, recorded.machine) != (VERSION, MACHINE):
        print(line("recorded with", f"version {recorded.version} on {recorded.machine}"))
        print(line("replayed with", f"version {VERSION} on {MACHINE}"))
    if told is not None and (differs := difference(recorded.simulation, told)):
        name, theirs, ours = differs
        problem = f"{folder}: the bag has {theirs}"
        raise InputError(name, theirs, f"the options say {ours}", problem)
    return recorded.simulation, recorded.period


def _verdict(result) -> str:
    """One line on a replay."""
    compared = f"{result.end:.3f} s"
    if not result.periods:
        compared += ", so that nothing was compared"
    elif result.is_exact:
        compared += ", every state reproduced to the bit"
    elif math.isinf(result.difference):
        compared += f", but {result.name} is nan at {result.time:.3f} s on one side"
    else:
        compared += (
            f", states apart by at most {result.relative:.2g} of their peak: "
            f"{result.name} by {result.difference:.2g} at {result.time:.3f} s"
        )
    if not math.isnan(result.missing_from):
        compared += f"; messages are missing from {result.missing_from:.3f} s on"
    return compared
