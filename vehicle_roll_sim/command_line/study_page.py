"""The page of a study: its map, and some of its runs, driven again."""

import argparse
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.arguments import named_file
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import check_page_format, check_writable
from vehicle_roll_sim.model.integration.events import VALUE
from vehicle_roll_sim.viewer.page import write_page
from vehicle_roll_sim.viewer.recording import ViewedRun
from vehicle_roll_sim.viewer.scene import scene_of
from vehicle_roll_sim.viewer.study_map import Quantity, StudyMap

NUMBER = re.compile("[0-9]{1,9}")
MOST_NAMED = 4
"""Inputs in the label of a run."""
NO_CONES = "Cones are left out: they differ between the runs."


def add_page_options(group: argparse._ArgumentGroup) -> None:
    """Add the options that `page_of` and `runs_of` read."""
    about = "write a page with a map of the runs, from which some can be seen in a browser (HTML)"
    group.add_argument("--view", metavar="FILE", help=about)
    about = (
        "numbers of the runs that the page opens, such as 3,17 (default: all, or those nearest to "
        "a threshold)"
    )
    group.add_argument("--runs", metavar="N,N", help=about)


def page_of(arguments: argparse.Namespace, folder: Path | None) -> Path | None:
    """Where the page goes, checked; it may go into the new folder of the study."""
    page = named_file(arguments.view, "--view")
    if page is None:
        if arguments.runs is not None:
            raise InputError("--runs", arguments.runs, "together with --view")
        return None
    check_page_format(page, "--view")
    if folder is None or page.parent != folder or folder.exists():
        check_writable(page, "--view")
    return page


def runs_of(arguments: argparse.Namespace) -> list[int] | None:
    """The numbers of the runs to open, None for the default; raises InputError."""
    from vehicle_roll_sim.studies.driven_again import MOST

    if arguments.runs is None:
        return None
    words = [word.strip() for word in arguments.runs.split(",")]
    if not all(NUMBER.fullmatch(word) for word in words) or len(words) > MOST:
        raise InputError("--runs", arguments.runs, f"1 to {MOST} whole numbers, such as 3,17")
    return list(dict.fromkeys(int(word) for word in words))


def write_study_page(path: Path, results, numbers: Sequence[int] | None, title: str) -> None:
    """Drive runs of a study (Results) again, and write the page. numbers: None for the default."""
    from vehicle_roll_sim.studies.driven_again import drive_again, numbers_to_show

    field = "--view" if numbers is None else "--runs"
    numbers = numbers_to_show(results) if numbers is None else numbers
    if not numbers:
        raise InputError(field, "", "a study with runs", "no run can be driven again")
    with signals.exit_on_signal():
        compile_model()
    driven = drive_again(results, numbers, field)
    runs = [
        ViewedRun(
            each.outcome.history,
            each.outcome.events,
            _label(each),
            scene_of(each.case.vehicle, each.case.options),
            each.case.simulation().road,
        )
        for each in driven
    ]
    cones, notes = _cones(driven)
    others = [str(each.number) for each in driven if not each.is_same]
    if others:
        notes.append(
            f"Driven again, run {', '.join(others)} differs from the table of the study, as "
            "happens on another kind of machine."
        )
    worst = int(np.argmax([abs(run.events.peak_roll[VALUE]) for run in runs]))
    write_page(path, runs, title, cones, notes, shown=[worst], study=_map(results, numbers))


def _label(run) -> str:
    named = list(run.inputs.items())[:MOST_NAMED]
    values = (f"{name} {v:.4g}" if isinstance(v, float) else f"{name} {v}" for name, v in named)
    return ", ".join([f"run {run.number}", *values])


def _cones(driven: Sequence) -> tuple[np.ndarray, list[str]]:
    """The cones of the runs if all have the same, (n, 2) (m); and notes about them."""
    found = []
    for each in driven:
        manoeuvre = each.case.ready_manoeuvre(each.case.simulation())
        found.append(np.reshape(list(getattr(manoeuvre, "cones", ())), (-1, 2)))
    if all(np.array_equal(each, found[0]) for each in found):
        return found[0], []
    return np.empty((0, 2)), [NO_CONES]


def _map(results, numbers: Sequence[int]) -> StudyMap:
    """The map over inputs, outputs and events; at first over two inputs that are numbers."""
    from vehicle_roll_sim.studies.driven_again import event_of
    from vehicle_roll_sim.studies.figures import labelled, magnitude_label
    from vehicle_roll_sim.studies.quantities import unit_of

    study, columns = results.study, results.columns
    inputs = []
    for name, values in columns.inputs.items():
        label = labelled(name, unit_of(name, study))
        texts = () if study.kinds[name] is float else tuple(dict.fromkeys(map(str, values)))
        places = np.array([texts.index(str(each)) for each in values] if texts else values, float)
        inputs.append(Quantity(label, places, texts))
    outputs = [
        Quantity(magnitude_label(name), values) for name, values in columns.magnitudes.items()
    ]
    events = [Quantity(name, each, ("no", "yes")) for name, each in columns.happened.items()]
    numeric = [place for place, each in enumerate(inputs) if not each.texts]
    if study.search:  # the last one
        numeric = [*numeric[:1], len(inputs) - 1] if len(numeric) > 1 else numeric
    first = [*numeric, len(inputs), len(inputs)][:2]
    colour = len(inputs) + len(outputs) + list(columns.happened).index(event_of(results))
    opens = {number: place for place, number in enumerate(numbers)}
    return StudyMap(columns.numbers, [*inputs, *outputs, *events], opens, (*first, colour))
