"""What the noise of the measured steering and speed does to the residuals.

The model is driven by the noise, too. What it makes of it passes through the vehicle, so that it is
slow, the same in all quantities, and larger near a rollover: nothing that the residuals could show
once values are fitted to them. It is drawn instead: the model is driven again with further noise.
"""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.identification.problem import Problem
from vehicle_roll_sim.identification.sensors import COMMANDS
from vehicle_roll_sim.logs.log import Log
from vehicle_roll_sim.logs.quantities import SPEED

DRAWS = 24
"""Of the noise."""
SEED = 364
ORDER = 4
"""Of the differences that leave the noise of a signal and nothing of its motion."""
MEDIAN = 0.6745
"""Of the magnitude of a normal variable, over its standard deviation."""


def noise_of(values: np.ndarray) -> float:
    """Standard deviation of the white noise of a signal, in its unit; values: (n,)."""
    size = math.sqrt(math.comb(2 * ORDER, ORDER))
    return float(np.median(np.abs(np.diff(values, ORDER)))) / (MEDIAN * size)


def noisier(log: Log, noise: np.random.Generator) -> Log:
    """The log with as much noise again in its steering and speed."""
    inputs = dict(log.inputs)
    for name in (*COMMANDS, SPEED):
        if name in inputs:
            time, values = inputs[name]
            inputs[name] = (time, values + noise.normal(0.0, 1.0, len(values)) * noise_of(values))
    return dataclasses.replace(log, inputs=inputs)


def responses(problem: Problem, scaled: np.ndarray) -> np.ndarray:
    """Changes of the residuals, without those of priors, by drawn noise, shape (DRAWS, n)."""
    noise = np.random.default_rng(SEED)
    logs = [[noisier(log, noise) for log in problem.logs] for _ in range(DRAWS)]
    return np.array(problem.rows_with(logs, scaled)) - problem.residuals(scaled)[: problem.rows]
