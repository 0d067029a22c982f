"""Runs of a study that are a formula."""

import math

import numpy as np

from vehicle_roll_sim.batch.case import Outcome
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS

SMALL = {
    "manoeuvre": "j_turn",
    "factors": {
        "vehicle.cg_height": {"lowest": 0.5, "highest": 0.8, "count": 4},
        "manoeuvre.speed": [10.0, 20.0, 30.0],
    },
    "chunk": 5,
}


def formula(cases, workers=None) -> list[Outcome]:
    """Peak roll = height * speed^2 / 400; a rollover from 1 on; heights above 0.79 diverge."""
    outcomes = []
    for case in cases:
        roll = case.vehicle.cg_height * case.manoeuvre.speed**2 / 400.0
        metrics = dict.fromkeys(METRIC_UNITS, math.nan) | {"peak_roll": -roll, "end_time": 6.0}
        condition, failure = Condition.RUNNING, ""
        if roll >= 1.0:
            metrics["rollover_time"], condition = 3.0, Condition.ROLLED_OVER
        if case.vehicle.cg_height > 0.79:
            metrics, condition, failure = {}, Condition.DIVERGED, "diverged at 1.000 s: u"
        outcomes.append(Outcome(metrics, failure, condition, np.zeros(40)))
    return outcomes
