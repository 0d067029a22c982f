"""Evaluation of cases: what fails is an outcome like any other, and never stops the others."""

from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.batch.case import Case, Outcome
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import STATE_SIZE
from vehicle_roll_sim.runs.run import DEFAULT_SAMPLE, run
from vehicle_roll_sim.runs.run_metrics import metrics_of
from vehicle_roll_sim.simulation.simulation import whole_steps


def evaluate(cases: Sequence[Case]) -> list[Outcome]:
    """Run all cases; returns their outcomes in the same order."""
    return [outcome_of(case) for case in cases]


def outcome_of(case: Case, history: bool = False) -> Outcome:
    """Run one case. history: keep the rows."""
    try:
        return _driven(case, history)
    except InputError as error:
        return Outcome({}, f"refused: {error}", None, np.full(STATE_SIZE, np.nan))


def _driven(case: Case, keeps_history: bool) -> Outcome:
    simulation = case.simulation()
    manoeuvre = case.ready_manoeuvre(simulation)
    whole_steps(manoeuvre.duration, simulation.step_ns, "duration")
    simulation.reset(manoeuvre.speed)
    history = run(simulation, manoeuvre.driver(), manoeuvre.duration, sample=DEFAULT_SAMPLE)
    metrics, failure = metrics_of(history, simulation.events, simulation.time), ""
    if simulation.condition is Condition.DIVERGED:
        culprit = simulation.implausible
        failure = f"diverged at {simulation.time:.3f} s: {culprit} is not plausible"
        metrics = {}
    return Outcome(
        metrics,
        failure,
        simulation.condition,
        simulation.state_vector.copy(),
        history if keeps_history else None,
    )
