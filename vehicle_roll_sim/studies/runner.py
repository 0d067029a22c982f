"""Runs of a study at given points: from the folder if they are done, else computed and kept."""

from collections.abc import Callable, Sequence

from vehicle_roll_sim.batch.case import Case, Outcome
from vehicle_roll_sim.batch.evaluate import evaluate
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.variants import MODELS
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.studies.quantities import case_of
from vehicle_roll_sim.studies.store import Store
from vehicle_roll_sim.studies.study import Study

COMPLETE, REFUSED = "complete", "refused"
REASON = "reason"
RESULTS = ("condition", REASON, *METRIC_UNITS)
"""Columns after the inputs. Metrics are nan for never, None if they are unknown: the run failed."""
UNKNOWN_WITHOUT_HEIGHTS = ("two_wheel_lift_time",)
"""Metrics that models without wheel heights do not have."""


class NotDoneError(Exception):
    """A run is needed that is not in the folder."""


class Runner:
    """Makes the runs of a study one chunk at a time, always in the same order.

    rows: all runs so far, as mappings. progress: called with the number of runs after each chunk,
    and whether they were in the folder. only_kept: raise NotDoneError instead of computing.
    """

    def __init__(
        self,
        study: Study,
        store: Store,
        progress: Callable[[int, bool], object] = lambda runs, kept: None,
        only_kept: bool = False,
    ):
        self.study, self.store, self.progress = study, store, progress
        self.only_kept = only_kept
        self.rows: list[dict] = []
        self._chunk = 0

    @property
    def columns(self) -> tuple[str, ...]:
        return ("run", *self.study.inputs, *RESULTS)

    def __call__(self, points: Sequence[dict]) -> list[dict]:
        """The runs at these points, values by name of the input; a mapping for each."""
        before, size = len(self.rows), self.study.settings.chunk
        for begin in range(0, len(points), size):
            self._add(points[begin : begin + size])
        return self.rows[before:]

    def _add(self, points: Sequence[dict]) -> None:
        kept = self.store.chunk(self._chunk)
        if kept is None:
            if self.only_kept:
                raise NotDoneError
            rows = self._computed(points)
            self.store.keep(self._chunk, rows)
        else:
            rows = self._checked(kept, points)
        self._chunk += 1
        self.rows += [dict(zip(self.columns, row, strict=True)) for row in rows]
        self.progress(len(rows), kept is not None)

    def _checked(self, rows: list[list], points: Sequence[dict]) -> list[list]:
        """Rows of the folder; raises InputError if they are not the runs of these points."""
        first, metrics = len(self.rows), len(RESULTS) - 2
        expected = [[first + i, *point.values()] for i, point in enumerate(points)]
        width = 1 + len(self.study.inputs)
        is_intact = isinstance(rows, list) and all(
            isinstance(row, list)
            and len(row) == len(self.columns)
            and all(isinstance(text, str) for text in row[width:-metrics])
            and all(isinstance(value, float | int | None) for value in row[-metrics:])
            for row in rows
        )
        if not is_intact or [row[:width] for row in rows] != expected:
            allowed = "the file as it was written; if you delete it, its runs are computed again"
            path = self.store.path(self._chunk)
            raise InputError(f"file {path}", "", allowed, "it has other runs")
        return rows

    def _computed(self, points: Sequence[dict]) -> list[list]:
        cases, refusals = {}, {}
        for index, point in enumerate(points):
            try:
                cases[index] = case_of(self.study, point)
            except InputError as error:
                refusals[index] = [REFUSED, f"refused: {error}", *[None] * len(METRIC_UNITS)]
        outcomes = zip(cases, evaluate(list(cases.values())), strict=True)
        results = refusals | {index: _results(cases[index], each) for index, each in outcomes}
        first = len(self.rows)
        return [
            [first + index, *point.values(), *results[index]] for index, point in enumerate(points)
        ]


def _results(case: Case, outcome: Outcome) -> list:
    """How a run ended, why it failed, and its metrics."""
    if outcome.condition is None:
        ending = REFUSED
    elif outcome.condition is Condition.RUNNING:
        ending = COMPLETE
    else:
        ending = outcome.condition.name.lower()
    unknown = UNKNOWN_WITHOUT_HEIGHTS if "eight_dof" in MODELS[case.options.model] else ()
    metrics = (None if name in unknown else outcome.metrics.get(name) for name in METRIC_UNITS)
    return [ending, outcome.failure, *metrics]
