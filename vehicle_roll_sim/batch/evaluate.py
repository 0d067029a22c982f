"""Evaluation of cases on all processors; a failure is an outcome and never stops the others."""

import collections
import os
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor

from vehicle_roll_sim.batch.case import Case, Outcome, unsuccessful
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.manoeuvres.driving import history_of
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.runs.run_metrics import metrics_of
from vehicle_roll_sim.simulation.limits import whole_steps
from vehicle_roll_sim.vehicle.plausibility import unwarned

AHEAD = 16
"""Cases that are under way or wait to be fetched, per thread: all that is in memory at once."""


def evaluate(cases: Sequence[Case], *, workers: int | None = None) -> list[Outcome]:
    """Run all cases; returns their outcomes in the same order, without histories.

    workers: number of threads, by default one for each processor that the process may use. Raises
    InputError for an invalid number of them, but never for a case.
    """
    return list(outcomes(cases, workers=workers))


def outcomes(
    cases: Iterable[Case], *, workers: int | None = None, histories: bool = False
) -> Iterator[Outcome]:
    """The outcomes of cases in their order, as they become known.

    cases: may be a generator, of any length: no more than a few dozen cases and outcomes are in
    memory at once. workers: as for `evaluate`. histories: whether outcomes have one.
    """
    workers = checked_workers(workers)
    pending: collections.deque[Future[Outcome]] = collections.deque()
    pool = ThreadPoolExecutor(workers, thread_name_prefix="batch")
    try:
        for case in cases:
            pending.append(pool.submit(outcome_of, case, histories))
            if len(pending) >= AHEAD * workers:
                yield pending.popleft().result()
        while pending:
            yield pending.popleft().result()
    finally:  # also if the caller stops early, or is interrupted
        pool.shutdown(cancel_futures=True)


def outcome_of(case: Case, history: bool = False) -> Outcome:
    """Run one case, in this thread. history: keep the rows.

    Issues no PlausibilityWarning.
    """
    try:
        with unwarned():
            return _driven(case, history)
    except Exception as error:  # of a driver of the user's own: the other cases go on
        return unsuccessful(error)


def processors() -> int:
    """The number of processors that this process may use."""
    return len(os.sched_getaffinity(0))


def checked_workers(workers: int | None) -> int:
    """The number of threads: as given, or one for each processor; raises InputError."""
    if workers is None:
        return processors()
    if isinstance(workers, bool) or not isinstance(workers, int) or workers < 1:
        raise InputError("workers", workers, "a whole number of at least 1")
    return workers


def _driven(case: Case, keeps_history: bool) -> Outcome:
    simulation = case.simulation()
    manoeuvre = case.ready_manoeuvre(simulation)
    whole_steps(manoeuvre.duration, simulation.step_ns, "duration")
    simulation.reset(manoeuvre.speed)
    driver = case.driver(manoeuvre, simulation)
    history = history_of(simulation, driver, manoeuvre.duration, with_commands=keeps_history)
    metrics, failure = metrics_of(history, simulation.events, simulation.time), ""
    if simulation.condition is Condition.DIVERGED:
        culprit = simulation.implausible
        metrics, failure = {}, f"diverged at {simulation.time:.3f} s: {culprit} is not plausible"
    return Outcome(
        metrics,
        failure,
        simulation.condition,
        simulation.state.copy(),
        *((history, simulation.events.copy()) if keeps_history else ()),
    )
