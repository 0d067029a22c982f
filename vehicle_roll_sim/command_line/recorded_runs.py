"""Recorded runs as arguments of a command: CSV files of `run --csv`, bags, and runs of studies."""

import argparse
import dataclasses
import math
import os
import re
import sys
from pathlib import Path

from vehicle_roll_sim.arguments import add_declared, declared_values, named_file
from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.files.output_file import check_writable
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_DEGREES
from vehicle_roll_sim.simulation.simulation import Simulation

LATEST = 1e10
"""s: later than any sample, even if times are counted from 1970."""


@dataclasses.dataclass(frozen=True)
class PartSettings:
    """Which part of the runs is shown, and what counts as a rollover in it."""

    begin: float = parameter("show from this time on (default: the first sample)", "s", 0.0, LATEST)
    end: float = parameter("show up to this time (default: the last sample)", "s", 0.0, LATEST)
    stop_roll: float = parameter(
        "roll angle that counts as a rollover", "deg", 1.0, 90.0, default=DEFAULT_ROLLOVER_DEGREES
    )


def add_runs(parser: argparse.ArgumentParser, metavar: str) -> None:
    """Add the files and the options that `files_of`, `part_settings` and `labels_of` read."""
    parser.add_argument(
        "files",
        metavar=metavar,
        nargs="+",
        help="a CSV file written by `run --csv`, a bag, or DIR#N for run N of the study in the "
        "folder DIR; several are overlaid",
    )
    parser.add_argument(
        "--namespace", metavar="NS", help="namespace of the vehicle, if the bag has several"
    )
    add_declared(parser, PartSettings, "range")


def add_names(group: argparse._ArgumentGroup, what: str, default: str) -> None:
    """Add the options for the title of `what`, with its default in words, and for labels."""
    group.add_argument(
        "--title",
        metavar="TEXT",
        help=f"title of the {what} (default: {default})",
    )
    group.add_argument(
        "--label",
        metavar="TEXT",
        action="append",
        help="label of a run; give it once for each run, in the same order",
    )


def files_of(arguments: argparse.Namespace, field: str, most: int, why: str) -> list[Path]:
    """The files named by the arguments; raises InputError if there are more than `most`.

    Likewise for a namespace without a bag.
    """
    files = [named_file(text, field) for text in arguments.files]
    if len(files) > most:
        raise InputError(field, f"{len(files)} files", f"at most {most}, {why}")
    if arguments.namespace is not None and not any(file.is_dir() for file in files):
        raise InputError("--namespace", arguments.namespace, "only for bags", "there is no bag")
    return files


def part_settings(arguments: argparse.Namespace) -> dict[str, float]:
    """The PartSettings that were given, with a `begin` and an `end`; raises InputError."""
    settings = {"begin": -math.inf, "end": math.inf} | declared_values(arguments, PartSettings)
    if not settings["begin"] < settings["end"]:
        raise InputError("--end", settings["end"], f"more than --begin, {settings['begin']:g}")
    return settings


def run_from(
    path: Path, namespace: str | None, field: str, with_forces: bool = False
) -> tuple[History, Simulation | None]:
    """The samples of a recorded run, and its simulation if a bag or a study describes it.

    with_forces: with the horizontal tire forces, which `last_run` leaves out of bags. Raises
    InputError naming `field` or the file if `path` is nothing of these.
    """
    if of_study := _run_of_study(path):
        return _driven_again(*of_study, field)
    if path.is_dir():
        signals.import_interruptibly("studies.store")
        from vehicle_roll_sim.studies.store import IDENTITY

        if (path / IDENTITY).exists():
            raise InputError(field, str(path), f"one run of the study, such as {path}#0")
        need_library(field)
        with signals.exit_on_signal():
            from vehicle_roll_sim.bags.reading import last_run  # its library is optional

        history, told = last_run(path, namespace, with_forces)
        return history, told.simulation if told else None
    return History.read_csv(path), None


def _run_of_study(path: Path) -> tuple[Path, int] | None:
    """Folder and number if a path is DIR#N, with the folder DIR and nothing of that name."""
    named = re.fullmatch(r"(.+)#([0-9]{1,9})", str(path), re.DOTALL)
    if named is None or path.exists() or not Path(named[1]).is_dir():
        return None
    return Path(named[1]), int(named[2])


def _driven_again(folder: Path, number: int, field: str) -> tuple[History, Simulation]:
    """The samples of a run of a study, and its simulation; raises InputError."""
    signals.import_interruptibly("studies.driven_again")
    from vehicle_roll_sim.studies.driven_again import drive_again, kept_results

    results = kept_results(folder, field)
    with signals.exit_on_signal():
        compile_model()
    (run,) = drive_again(results, [number], field)
    if not run.is_same:
        print(
            f"{signals.PROGRAM}: warning: {folder}: driven again, run {number} differs from the "
            "table of the study, as happens on another kind of machine",
            file=sys.stderr,
        )
    return run.outcome.history, run.case.simulation()


def part_of(history: History, settings: dict[str, float], path: Path) -> History:
    """The samples from `begin` to `end` (s); raises InputError if there are none."""
    time, begin, end = history["time"], settings["begin"], settings["end"]
    part = history.part((begin <= time) & (time <= end))
    if not len(part.rows):
        field, value = ("--begin", begin) if begin > time[0] else ("--end", end)
        raise InputError(field, value, f"samples of {path}, {time[0]:g} to {time[-1]:g} s")
    return part


def output_of(given: str | None, option: str, suffix: str, files: list[Path]) -> Path:
    """Where the result goes: as given or, for a single run, its name with another suffix."""
    output = named_file(given, option)
    if output is None:
        if len(files) > 1:
            raise InputError(option, None, "the file for the result of several runs")
        output = files[0].parent / f"{name_of(files[0])}{suffix}"
    return output


def check_output(output: Path, option: str, files: list[Path]) -> None:
    """Raise InputError if the result cannot be written, or would replace a run."""
    check_writable(output, option)
    if any(output.exists() and file.exists() and output.samefile(file) for file in files):
        raise InputError(option, str(output), "another file than those of the runs")


def labels_of(given: list[str] | None, files: list[Path]) -> list[str]:
    """The labels of the runs: those given, else the names of their files."""
    if given is None:
        names = [name_of(file) for file in files]
        return names if len(set(names)) == len(names) else [str(file) for file in files]
    if len(given) != len(files):
        raise InputError("--label", f"{len(given)} labels", f"one for each of {len(files)} files")
    return given


def name_of(path: Path) -> str:
    """The name of a file or folder without its suffix; that of a run of a study with its number."""
    path = Path(os.path.abspath(path))
    return path.name if _run_of_study(path) else path.stem
