"""The results of chunks of runs: a chunk depends on nothing but the study and its points."""

from collections.abc import Callable, Iterable, Iterator, Sequence

from vehicle_roll_sim.batch.case import Case, Outcome
from vehicle_roll_sim.batch.evaluate import evaluate
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.variants import MODELS
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.studies.quantities import case_of
from vehicle_roll_sim.studies.study import Study

COMPLETE, REFUSED = "complete", "refused"
CONDITION, REASON = "condition", "reason"
RESULTS = (CONDITION, REASON, *METRIC_UNITS)
"""Columns after the inputs. Metrics are nan for never, None if they are unknown: the run failed."""
UNKNOWN_WITHOUT_HEIGHTS = ("two_wheel_lift_time", "peak_wheel_lift", "peak_wheel_lift_time")
"""Metrics that models without wheel heights do not have."""
Chunk = tuple[int, Sequence[dict]]
"""The number of a chunk, and the points of its runs: values by name of the input."""
Compute = Callable[[Study, Iterable[Chunk]], Iterator[tuple[int, list[list]]]]
"""A function that computes chunks: yields the number and the results of each, in any order."""


def one_by_one(study: Study, chunks: Iterable[Chunk]) -> Iterator[tuple[int, list[list]]]:
    """Compute chunks one after the other, each on all processors of this machine."""
    for number, points in chunks:
        yield number, results_at(study, points)


def results_at(
    study: Study, points: Sequence[dict], workers: int | None = None
) -> list[list[str | float | None]]:
    """The RESULTS of the runs at these points, a list for each. workers: as for `evaluate`."""
    cases, results = {}, {}
    for index, point in enumerate(points):
        try:
            cases[index] = case_of(study, point)
        except InputError as error:
            results[index] = [REFUSED, f"refused: {error}", *[None] * len(METRIC_UNITS)]
    outcomes = evaluate(list(cases.values()), workers=workers)
    for index, outcome in zip(cases, outcomes, strict=True):
        results[index] = _results(cases[index], outcome)
    return [results[index] for index in range(len(points))]


def unknown_metrics(model: str) -> tuple[str, ...]:
    """The metrics that a model does not have."""
    return UNKNOWN_WITHOUT_HEIGHTS if "eight_dof" in MODELS[model] else ()


def _results(case: Case, outcome: Outcome) -> list[str | float | None]:
    """How a run ended, why it failed, and its metrics."""
    if outcome.condition is None:
        ending = REFUSED
    elif outcome.condition is Condition.RUNNING:
        ending = COMPLETE
    else:
        ending = outcome.condition.name.lower()
    unknown = unknown_metrics(case.options.model)
    metrics = (None if name in unknown else outcome.metrics.get(name) for name in METRIC_UNITS)
    return [ending, outcome.failure, *metrics]
