"""The executable `score`: controllers in lockstep over a catalogue of tests, and a report."""

import argparse
import importlib.metadata
import os
import platform
import shlex
import sys
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import rclpy
from tqdm import tqdm

from vehicle_roll_sim.arguments import WRONG_INPUT, exit_status, named_file
from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.ros.orchestration.bench import Bench, bench, context
from vehicle_roll_sim.ros.orchestration.compare import SET_HERE, assignment, domain_of
from vehicle_roll_sim.ros.orchestration.comparison import noted_signals
from vehicle_roll_sim.ros.orchestration.controller_processes import (
    Controller,
    controller_of,
)
from vehicle_roll_sim.ros.orchestration.demo import LOCAL
from vehicle_roll_sim.ros.orchestration.scoring_run import Scoring
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.scoring import report
from vehicle_roll_sim.scoring.catalogue import TESTS
from vehicle_roll_sim.scoring.options import ANSWERS, parser_of, patience_of
from vehicle_roll_sim.scoring.plan import Ladder, Setup, ladders
from vehicle_roll_sim.scoring.results import Score
from vehicle_roll_sim.scoring.spread import SPREAD
from vehicle_roll_sim.scoring.store import Store, fingerprint
from vehicle_roll_sim.simulation.compilation import compile_model
from vehicle_roll_sim.simulation.description import describe
from vehicle_roll_sim.vehicle.plausibility import unwarned
from vehicle_roll_sim.version import __version__


def score(arguments: argparse.Namespace) -> tuple[list[str], int]:
    """Check the arguments, drive what is missing and write the report.

    Returns the lines to print, and the exit status: that of wrong input if a controller failed.
    """
    controllers = controllers_of(arguments)
    planned = ladders(arguments.only or (), arguments.quick)
    if not planned:
        raise InputError("--only", " ".join(arguments.only), "a test of this size; see --help")
    parameters = [_parameter(each) for each in arguments.simulator]
    patience, folder = patience_of(arguments.patience), named_file(arguments.out, "--out")
    need_library("--out")
    with domain_of(arguments.domain) as domain, noted_signals() as interrupted:
        os.environ.update(LOCAL | {"ROS_DOMAIN_ID": str(domain)})
        compile_model()
        with context("score"), unwarned():
            done = _Done(folder, controllers, planned, arguments)
            for controller in controllers:
                with bench(controller.answers, parameters, patience) as rig:
                    done.drive(rig, controller, interrupted)
            written = done.report()
            if interrupted.is_set():
                raise KeyboardInterrupt
            report.write_report(written, folder)
    lines = [_told(each) for each in done.scores]
    lines += [line("report", folder / report.PAGE), line("as Markdown", folder / report.TEXT)]
    failed = any(each.failure for each in done.scores)
    return lines, WRONG_INPUT if failed else 0


class _Done:
    """What has been scored so far."""

    def __init__(
        self,
        folder: Path,
        controllers: Sequence[Controller],
        planned: Sequence[Ladder],
        arguments: argparse.Namespace,
    ):
        self.scores: list[Score] = []
        self._folder, self._controllers, self._planned = folder, controllers, planned
        self._arguments = arguments
        self._worst: dict[str, report.Worst] = {}
        self._setup: Setup | None = None

    def drive(self, rig: Bench, controller: Controller, interrupted: threading.Event) -> None:
        """Score a controller."""
        if self._setup is None:
            self._setup = rig.setup
            for ladder in self._planned:
                ladder.simulation(self._setup)  # raises InputError before anything is driven
            session = rig.simulator.session
            described = describe(session.simulation, session.period_ns)
            identity = identity_of(self._controllers, self._planned, described)
            identity["simulator"] = sorted(self._arguments.simulator)
            self._store = Store(self._folder, identity, "--out")
        total = sum(len(each.levels) for each in self._planned)
        with tqdm(total=total, disable=None, leave=False, unit=" runs") as bar:

            def progress(name: str) -> None:
                bar.set_description(name, refresh=False)
                bar.update()

            scoring = Scoring(
                rig,
                controller,
                self._store,
                self._setup,
                restarts=self._arguments.restart,
                interrupted=interrupted,
                progress=progress,
            )
            found = scoring.score(self._planned)
        self.scores.append(found)
        if not found.failure:
            ladder, level = found.worst
            driven = self._store.load(report.slug(controller.name), ladder.name(level))
            worst = report.worst_of(ladder, level, self._setup, driven)
            self._worst[controller.name] = worst

    def report(self) -> report.Report:
        """The report; raises InputError if no controller could be scored."""
        if all(each.failure for each in self.scores):
            first = self.scores[0]
            raise InputError(first.controller, "", "see docs/scores.md", first.failure)
        commands = {each.name: started_as(each) for each in self._controllers}
        quick = self._arguments.quick
        return report.Report(self._setup, self.scores, commands, versions(), self._worst, quick)


def controllers_of(arguments: argparse.Namespace) -> list[Controller]:
    """The controllers that the arguments name; raises InputError."""
    answers = arguments.answers or ()
    for name in answers:
        if name not in ANSWERS:
            raise InputError("--answers", name, "one of " + ", ".join(ANSWERS))
    given = [assignment(each, "--parameter") for each in arguments.parameter]
    found = [controller_of(each, given, answers, "CONTROLLER") for each in arguments.controllers]
    for each in found:
        for name in each.answers:
            if name not in ANSWERS:
                allowed = f"a controller of {', '.join(ANSWERS)}"
                raise InputError("CONTROLLER", each.name, allowed, f"{each.name} commands {name}")
    names = [report.slug(each.name) for each in found]
    for name in names:
        if names.count(name) > 1:
            raise InputError("CONTROLLER", name, "controllers of different names")
    return found


def started_as(controller: Controller) -> str:
    """The programs of a controller, with the names of scripts only, and the sum of their files."""
    programs = []
    for words in controller.programs:
        shown = [Path(word).name if Path(word).is_absolute() else word for word in words]
        programs.append(shlex.join(shown[1:] if words[0] == sys.executable else shown))
    sums = " ".join(fingerprint(each.read_bytes()) for each in controller.files)
    return " + ".join(programs) + (f" (SHA-256 {sums})" if sums else "")


def identity_of(
    controllers: Sequence[Controller], planned: Sequence[Ladder], described: str
) -> dict:
    """What the results of a score depend on. described: the simulation."""
    return {
        "versions": versions(),
        "controllers": {each.name: [started_as(each), *each.answers] for each in controllers},
        "ladders": [f"{each.name(each.levels[0])} to {each.levels[-1]:g}" for each in planned],
        "catalogue": fingerprint(repr((TESTS.keys(), SPREAD)).encode()),
        "simulation": fingerprint(described.encode()),
    }


def versions() -> Mapping[str, str]:
    """The versions of the programs that made a score."""
    return {
        "vehicle_roll_sim": __version__,
        "Python": platform.python_version(),
        "numpy": np.__version__,
        "rclpy": importlib.metadata.version("rclpy"),
        "middleware": rclpy.get_rmw_implementation_identifier(),
    }


def _parameter(text: str) -> str:
    name = assignment(text, "--simulator").partition(":=")[0]
    if name in SET_HERE:
        raise InputError("--simulator", text, f"any parameter but {' and '.join(SET_HERE)}")
    return text


def _told(found: Score) -> str:
    if found.failure:
        return line(found.controller, f"not scored: {found.failure}")
    pairs = [(climb.limit_alone, climb.limit) for climb in found.climbs]
    raised, lowered = sum(b > a for a, b in pairs), sum(b < a for a, b in pairs)
    return line(found.controller, f"{raised} of {len(pairs)} limits raised, {lowered} lowered")


def main() -> int:
    """Entry point of the executable."""
    parser = parser_of("score")

    def command() -> int:
        lines, status = score(parser.parse_args())
        print("\n".join(lines))
        return status

    return exit_status(command, parser.prog)


if __name__ == "__main__":
    sys.exit(main())
