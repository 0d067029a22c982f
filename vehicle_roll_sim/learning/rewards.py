"""The reward of an agent that drives on and keeps the vehicle on its wheels."""

import numpy as np

from vehicle_roll_sim.learning.observations import Signals

SPEED = 20.0
"""m/s: forward speed with a reward of 1. Without a reward for speed it would be best to stop."""
EFFORT = 0.1
"""Weight of the mean square of the actions."""
ROLLOVER = -100.0
"""Reward of a rollover."""


def upright_progress(signals: Signals, actions: np.ndarray, rolled_over: np.ndarray) -> np.ndarray:
    """Reward of one period, shape (n,).

    u / (20 m/s) - (load transfer ratio)^2 - 0.1 (mean square of the actions), and -100 at a
    rollover. signals: observations by name at the end of the period, each of shape (n,), or (n, 4)
    if it has a value for each wheel. actions: shape (n, k), after clamping. rolled_over: whether
    the vehicle has rolled over in this period, shape (n,).
    """
    progress = signals["u"] / SPEED - signals["load_transfer_ratio"] ** 2
    return progress - EFFORT * np.mean(np.square(actions), axis=1) + ROLLOVER * rolled_over
