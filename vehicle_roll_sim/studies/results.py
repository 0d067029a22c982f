"""The results of a study: all runs, and what was searched for."""

import dataclasses
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.studies.designs import drawn_at, points_of
from vehicle_roll_sim.studies.runner import NotDoneError, Runner
from vehicle_roll_sim.studies.search import Bracket, brackets
from vehicle_roll_sim.studies.store import Store
from vehicle_roll_sim.studies.study import Study
from vehicle_roll_sim.studies.subset_simulation import Estimate, subset_simulation
from vehicle_roll_sim.vehicle.plausibility import unwarned


@dataclasses.dataclass(frozen=True)
class Results:
    """The runs of a study so far, and what follows from all of them.

    rows: mappings by name of the column. brackets: of a search, estimate: of a rare event; None
    without one, or while runs are missing.
    """

    study: Study
    columns: tuple[str, ...]
    rows: list[dict]
    brackets: list[Bracket] | None = None
    estimate: Estimate | None = None
    is_complete: bool = True


def magnitudes(rows: list[dict], metric: str) -> np.ndarray:
    """The magnitude of a metric in each run, shape (runs,); nan for never and for unknown.

    A peak has the sign of its direction, which the tables keep.
    """
    return np.abs([np.nan if row[metric] is None else row[metric] for row in rows])


def results_of(
    study: Study,
    store: Store,
    progress: Callable[[int, bool], object] = lambda runs, kept: None,
    only_kept: bool = False,
) -> Results:
    """Make the runs of a study that are not in its folder yet; arguments as for Runner."""
    runner = Runner(study, store, progress, only_kept)
    found = {}
    try:
        with unwarned():  # values are drawn, not typed
            found = _found(study, runner)
    except NotDoneError:
        return Results(study, runner.columns, runner.rows, is_complete=False)
    return Results(study, runner.columns, runner.rows, **found)


def _found(study: Study, runner: Runner) -> dict:
    if study.rare:
        event = study.events[study.rare.event]

        def margin(scores: np.ndarray) -> np.ndarray:
            return np.array([event.margin(row) for row in runner(drawn_at(study, scores))])

        size = (study.rare.level_runs, study.rare.most_levels)
        return {"estimate": subset_simulation(margin, len(study.drawn), study.settings.seed, *size)}
    if study.search:
        event = study.events[study.search.event]
        return {"brackets": brackets(study.search, event, points_of(study), runner)}
    runner(points_of(study))
    return {}
