"""Classical fourth-order Runge-Kutta integration with a fixed step."""

from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.integration.derivatives import derivatives

STAGE_VECTORS = 7
"""Rows of the work space: four slopes, the trial state, the state before the step, and the state at
the end of the last call of `advance`."""
K1, K2, K3, K4, TRIAL, BEFORE, KEPT = range(STAGE_VECTORS)


@kernel
def copy(state, result):
    """result = state; element by element, which compiles ten times as fast as a slice."""
    for i in range(len(state)):
        result[i] = state[i]


@kernel
def along(state, slope, interval, result):
    """result = state + interval * slope."""
    for i in range(len(state)):
        result[i] = state[i] + interval * slope[i]


@kernel
def rk4_step(state, midway, after, time, step, car, ground, stages):
    """Advance `state` in place by one step (s); stages[K1] must contain its first slope.

    midway, after: commands at the middle and the end of the step, which begins at `time` (s). car:
    vehicle, tires, options and outputs, as for `derivatives`, like ground.
    """
    vehicle, tires, options, outputs = car
    half, end = time + step / 2, time + step
    trial = stages[TRIAL]
    along(state, stages[K1], step / 2, trial)
    derivatives(trial, midway, vehicle, tires, options, ground, half, outputs, stages[K2])
    along(state, stages[K2], step / 2, trial)
    derivatives(trial, midway, vehicle, tires, options, ground, half, outputs, stages[K3])
    along(state, stages[K3], step, trial)
    derivatives(trial, after, vehicle, tires, options, ground, end, outputs, stages[K4])
    for i in range(len(state)):
        inner = stages[K2, i] + stages[K3, i]
        state[i] += step / 6 * (stages[K1, i] + 2 * inner + stages[K4, i])
