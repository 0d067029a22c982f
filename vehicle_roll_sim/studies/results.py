"""The results of a study: all runs, and what was searched for."""

import collections
import dataclasses
import functools
import math
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.studies.chunks import REASON, Compute, one_by_one
from vehicle_roll_sim.studies.designs import Points, drawn_at, points_of
from vehicle_roll_sim.studies.runner import KeptRuns, NotDoneError, Runner
from vehicle_roll_sim.studies.search import Bracket, brackets
from vehicle_roll_sim.studies.store import Store
from vehicle_roll_sim.studies.study import Study
from vehicle_roll_sim.studies.subset_simulation import Estimate, subset_simulation
from vehicle_roll_sim.vehicle.plausibility import unwarned


@dataclasses.dataclass(frozen=True)
class Columns:
    """What summary and figures need of all runs; arrays of shape (runs,).

    numbers: of the runs. inputs: lists for values that are not numbers. magnitudes: of the outputs,
    nan for never and unknown; a peak has the sign of its direction only in the tables. happened:
    1.0 or 0.0 by event, nan if that is unknown. failed: whether a run did. reasons: number of
    failed runs by reason.
    """

    numbers: np.ndarray
    inputs: dict[str, np.ndarray | list]
    magnitudes: dict[str, np.ndarray]
    happened: dict[str, np.ndarray]
    failed: np.ndarray
    reasons: collections.Counter[str]


@dataclasses.dataclass(frozen=True)
class Results:
    """The runs of a study so far, and what follows from all of them.

    brackets: of a search, estimate: of a rare event; None without one, or while runs are missing.
    """

    study: Study
    runs: KeptRuns
    brackets: list[Bracket] | None = None
    estimate: Estimate | None = None
    is_complete: bool = True

    @functools.cached_property
    def columns(self) -> Columns:
        """Read from the folder in one pass, since all rows may be more than fits into memory."""
        study, count = self.study, len(self.runs)
        numbers = np.empty(count, int)
        inputs = {
            name: np.empty(count) if kind is float else [None] * count
            for name, kind in study.kinds.items()
        }
        magnitudes = {name: np.empty(count) for name in study.outputs}
        happened = {name: np.empty(count) for name in study.events}
        failed = np.zeros(count, bool)
        reasons = collections.Counter()
        for i, row in enumerate(self.runs):
            numbers[i] = row["run"]
            for name, column in inputs.items():
                column[i] = row[name]
            for name, column in magnitudes.items():
                column[i] = math.nan if row[name] is None else abs(row[name])
            for name, column in happened.items():
                event = study.events[name].happened(row)
                column[i] = math.nan if event is None else event
            if row[REASON]:
                failed[i] = True
                reasons[row[REASON]] += 1
        return Columns(numbers, inputs, magnitudes, happened, failed, reasons)


def results_of(
    study: Study,
    store: Store,
    progress: Callable[[int, bool], object] = lambda runs, kept: None,
    compute: Compute | None = one_by_one,
) -> Results:
    """Make the runs of a study that are not in its folder yet; arguments as for Runner."""
    runner = Runner(study, store, progress, compute)
    try:
        with unwarned():  # values are drawn, not typed
            found = _found(study, runner)
    except NotDoneError:
        return Results(study, runner.runs, is_complete=False)
    return Results(study, runner.runs, **found)


def _found(study: Study, runner: Runner) -> dict:
    if study.rare:
        event = study.events[study.rare.event]

        def margin(scores: np.ndarray) -> np.ndarray:
            points = Points(tuple(study.drawn), [{}], drawn_at(study, scores), len(scores))
            return np.array([event.margin(row) for row in runner(points)])

        size = (study.rare.level_runs, study.rare.most_levels)
        return {"estimate": subset_simulation(margin, len(study.drawn), study.settings.seed, *size)}
    if study.search:
        event = study.events[study.search.event]
        return {"brackets": brackets(study.search, event, points_of(study), runner)}
    runner(points_of(study))
    return {}
