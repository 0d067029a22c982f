"""Spaces of gymnasium for actions and observations."""

import numpy as np
from gymnasium.spaces import Box

from vehicle_roll_sim.learning.actions import Actions
from vehicle_roll_sim.learning.observations import Observer


def action_space(actions: Actions) -> Box:
    """Numbers from -1 or 0 to 1, shape (k,)."""
    return Box(actions.lowest.astype(np.float32), np.float32(1.0), dtype=np.float32)


def observation_space(observer: Observer) -> Box:
    """Quantities in SI units and radians within their bounds, shape (m,)."""
    return Box(-observer.bounds, observer.bounds, dtype=np.float64)
