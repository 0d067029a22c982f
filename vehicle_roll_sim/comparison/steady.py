"""The quasi-steady part of a log: gradients of understeer and roll, and what is judged there."""

import dataclasses

import numpy as np

from vehicle_roll_sim.logs.quantities import ACCELERATION, SPEED
from vehicle_roll_sim.runs.metrics import roll_gradient, understeer_gradient

SLOWEST_CHANGE = 2.0
"""m/s^3: largest rate of lateral acceleration, simulated; slowly increasing steer has 1 to 1.5."""
BRAKING = 1.0
"""m/s^2: largest rate of the simulated speed."""
LONG_ENOUGH = 0.5
"""s for which both hold without a break."""
LINEAR = 4.0
"""m/s^2: gradients are those up to this lateral acceleration, where they are nearly constant."""
SMALLEST_RANGE = 1.0
"""m/s^2 of lateral acceleration, for gradients."""


@dataclasses.dataclass(frozen=True)
class Gradients:
    """Gradients (rad/(m/s^2)) of one side, nan where the log does not have the signals."""

    understeer: float
    roll: float


def quasi_steady(simulated: dict[str, np.ndarray], interval: float) -> np.ndarray:
    """Which samples are quasi-steady, a boolean for each, (n,). interval: of the samples (s)."""
    from scipy.ndimage import binary_opening  # scipy takes 0.25 s to import

    acceleration, speed = simulated[ACCELERATION], simulated[SPEED]
    is_slow = (np.abs(np.gradient(acceleration, interval)) <= SLOWEST_CHANGE) & (
        np.abs(np.gradient(speed, interval)) <= BRAKING
    )
    size = max(1, round(LONG_ENOUGH / interval))
    return binary_opening(is_slow, np.ones(size, bool))


def has_range(acceleration: np.ndarray, is_steady: np.ndarray) -> bool:
    """Whether the quasi-steady samples turn enough to say anything. acceleration: m/s^2."""
    return is_steady.any() and float(np.ptp(acceleration[is_steady])) >= SMALLEST_RANGE


def gradients(
    signals: dict[str, np.ndarray],
    steering: np.ndarray,
    is_steady: np.ndarray,
    wheelbase: float,
) -> Gradients:
    """The gradients of one side in the linear range of the quasi-steady part.

    signals, steering (road wheels, rad): (n,) each. wheelbase: m.
    """
    unknown = np.full(len(steering), np.nan)
    acceleration = signals.get(ACCELERATION, unknown)
    chosen = is_steady & (np.abs(acceleration) <= LINEAR)
    if not has_range(acceleration, chosen):
        return Gradients(np.nan, np.nan)
    yaw_rate, roll = (signals.get(name, unknown)[chosen] for name in ("yaw_rate", "roll"))
    turn = acceleration[chosen]
    speed = signals[SPEED][chosen]
    understeer = understeer_gradient(turn, steering[chosen], yaw_rate, speed, wheelbase)
    return Gradients(understeer, roll_gradient(turn, roll))
