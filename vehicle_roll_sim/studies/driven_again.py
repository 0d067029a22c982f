"""Runs of a study, driven again for what its folder does not keep: their histories."""

import dataclasses
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from vehicle_roll_sim.batch.case import Case, Outcome
from vehicle_roll_sim.batch.evaluate import outcomes
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.studies.chunks import REASON
from vehicle_roll_sim.studies.quantities import case_of
from vehicle_roll_sim.studies.results import Results, results_of
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.store import IDENTITY, TEXTS, Store, other_code
from vehicle_roll_sim.studies.study_file import study_of
from vehicle_roll_sim.vehicle.plausibility import unwarned

MOST = 30
"""Runs that are driven again together, with their histories in memory."""
ROUNDING = 1e-9
"""Relative difference below which two distances count as equal."""


@dataclasses.dataclass(frozen=True)
class DrivenAgain:
    """A run that was driven again.

    inputs: its values by name. is_same: whether its metrics are those in the folder to the last
    bit, as on the same kind of machine with the same libraries.
    """

    number: int
    inputs: dict
    case: Case
    outcome: Outcome
    is_same: bool


def kept_results(folder: Path, field: str) -> Results:
    """The runs in the folder of a study, with the vehicle of which they are.

    A vehicle file is looked for from the current folder. Raises InputError if the vehicle or the
    version of the program has changed since.
    """
    store = Store(folder)
    identity = store.identity(field)
    again = "its runs can be seen by repeating `study STUDY.yaml --out DIR` with --view"
    try:
        with unwarned():
            study = study_of(Source(identity["study"], path=Path(IDENTITY)))
    except InputError as error:
        raise InputError(field, "", again, f"{folder}: {error.field}: {error.problem}") from None
    now = study.identity
    for key in TEXTS:
        if identity[key] != now[key]:
            what = f"version {identity[key]} of the program" if key == "version" else "a vehicle"
            problem = f"{folder} has the results of {what} that is not here"
            raise InputError(field, "", again, problem)
    if section := other_code(identity, now):
        raise InputError(field, "", again, f"{folder} has the results of another {section}")
    return results_of(study, store, compute=None)


def drive_again(results: Results, numbers: Sequence[int], field: str) -> list[DrivenAgain]:
    """The runs with these numbers, in this order; raises InputError naming `field`."""
    wanted = {*numbers}
    rows = {row["run"]: row for row in results.runs if row["run"] in wanted}
    for number in numbers:
        if number not in rows:
            raise InputError(field, number, f"a run of the study, 0 to {len(results.runs) - 1}")
        if rows[number][REASON]:
            raise InputError(field, number, "a run that did not fail", rows[number][REASON])
    points = [{name: rows[number][name] for name in results.study.inputs} for number in numbers]
    with unwarned():  # values are drawn, not typed
        cases = [case_of(results.study, point) for point in points]
    return [
        DrivenAgain(number, point, case, outcome, _is_same(outcome, rows[number]))
        for number, point, case, outcome in zip(
            numbers, points, cases, outcomes(cases, histories=True), strict=True
        )
    ]


def _is_same(outcome: Outcome, row: dict) -> bool:
    pairs = [(outcome.metrics.get(name, math.nan), row[name]) for name in METRIC_UNITS]
    known = [pair for pair in pairs if pair[1] is not None]
    return all(new == old or (math.isnan(new) and math.isnan(old)) for new, old in known)


def numbers_to_show(results: Results, most: int = MOST) -> list[int]:
    """The runs that say most: all that did not fail or, of more than `most`, those at a threshold.

    These are the runs nearest to one in which the event of the study went the other way. Factors
    are scaled by their ranges; values that are not numbers are one apart. Equally near runs, and
    all runs if the event always or never happens, are taken at equal distances in their order.
    """
    columns = results.columns
    usable = np.flatnonzero(~columns.failed)
    if len(usable) > most:
        distances = _distances(results)[usable]
        farthest = np.partition(distances, most - 1)[most - 1]
        near = usable[distances <= farthest * (1.0 + ROUNDING)]
        usable = near[np.linspace(0, len(near) - 1, most).round().astype(int)]
    return columns.numbers[usable].tolist()


def event_of(results: Results) -> str:
    """The event that is searched for, or the first of the study."""
    study = results.study
    kind = study.search or study.rare
    return kind.event if kind else next(iter(study.events))


def _distances(results: Results) -> np.ndarray:
    """From each run to the nearest with the other outcome of the event, (n,); inf for none."""
    happened, places = results.columns.happened[event_of(results)], _places(results)
    distances = np.full(len(happened), np.inf)
    for outcome in (0.0, 1.0):
        own, other = happened == outcome, happened == 1.0 - outcome
        if own.any() and other.any():
            distances[own] = cKDTree(places[other]).query(places[own])[0]
    return distances


def _places(results: Results) -> np.ndarray:
    """Factors of the runs scaled to 0 ... 1, (n, columns)."""
    found = [np.zeros(len(results.runs))]  # a study need not have factors
    for values in results.columns.inputs.values():
        if isinstance(values, list):
            names = list(dict.fromkeys(values))
            found += [np.array([value == name for value in values]) / 2**0.5 for name in names]
        else:
            span = np.ptp(values)
            found.append((values - values.min()) / span if span else np.zeros(len(values)))
    return np.column_stack(found)
