"""The reward of an agent that keeps a vehicle on its wheels."""

import numpy as np

from vehicle_roll_sim.learning.observations import Signals

EFFORT = 0.1
"""Weight of the mean square of the actions."""
ROLLOVER = -100.0
"""At a rollover."""


def upright(signals: Signals, actions: np.ndarray, rolled_over: np.ndarray) -> np.ndarray:
    """Reward of one period, shape (n,): 1 - (load transfer ratio)^2 - 0.1 (actions^2), and -100.

    signals: observations by name at the end of the period, each of shape (n,), or (n, 4) if it has
    a value for each wheel. actions: shape (n, k), after clamping; their mean square counts.
    rolled_over: whether the vehicle has rolled over in this period, shape (n,).
    """
    effort = np.mean(np.square(actions), axis=1)
    return 1.0 - signals["load_transfer_ratio"] ** 2 - EFFORT * effort + ROLLOVER * rolled_over
