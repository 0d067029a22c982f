"""Signs and units of a log that contradict each other, by relations that hold for any vehicle."""

from collections.abc import Iterator

import numpy as np

OPPOSITE = -0.5
"""Correlation: a smaller one is taken for a swapped sign."""
FAR = 2.0
"""Factor between two measures of one quantity: a larger one is taken for a wrong unit."""
FEWEST_TURNS = 0.02
"""rad/s: rms of the yaw rate, and of lateral acceleration over speed, below which the log says
nothing about signs and units."""


def doubts_about(signals: dict[str, np.ndarray], interval: float) -> list[str]:
    """One line for each contradiction. signals: filtered, by quantity, each (n,).

    interval: s. Relations: lateral acceleration = speed times yaw rate, yaw rate towards the
    steering, roll towards the outside of the turn, roll rate = derivative of roll.
    """
    if "yaw_rate" not in signals or not _turns(signals):
        return []
    return list(_contradictions(signals, interval))


def _turns(signals: dict[str, np.ndarray]) -> bool:
    """Whether the vehicle turns by one of two signals: the unit of the other may be wrong."""
    by_acceleration = _rms(signals.get("lateral_acceleration", np.zeros(1)))
    speed = _rms(signals["speed"])
    return max(_rms(signals["yaw_rate"]) * speed, by_acceleration) >= FEWEST_TURNS * speed


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _contradictions(signals: dict[str, np.ndarray], interval: float) -> Iterator[str]:
    acceleration, roll = signals.get("lateral_acceleration"), signals.get("roll")
    turning = signals["yaw_rate"] * signals["speed"]
    pairs = [
        ("lateral_acceleration", acceleration, turning, "yaw_rate times speed"),
        ("yaw_rate", signals["yaw_rate"], signals.get("steering"), "steering"),
        ("roll", roll, acceleration, "lateral_acceleration"),
    ]
    if roll is not None:
        rate = np.gradient(roll, interval)
        pairs.append(("roll_rate", signals.get("roll_rate"), rate, "the derivative of roll"))
    for name, one, other, about in pairs:
        if one is not None and other is not None and correlation(one, other) < OPPOSITE:
            yield (
                f"{name} has the opposite sign of {about} (correlation "
                f"{correlation(one, other):.2f}): sign: -1 for one of them, or axes: sae"
            )
    if acceleration is not None and abs(correlation(acceleration, turning)) > -OPPOSITE:
        ratio = _rms(acceleration) / _rms(turning)
        if not 1.0 / FAR < ratio < FAR:
            yield (
                f"lateral_acceleration is {ratio:.3g} times yaw_rate times speed: "
                "is one of the three units wrong?"
            )


def correlation(one: np.ndarray, other: np.ndarray) -> float:
    """Correlation coefficient of two signals (n,); nan if one of them is constant."""
    deviations = one - one.mean(), other - other.mean()
    size = np.sqrt(np.sum(deviations[0] ** 2) * np.sum(deviations[1] ** 2))
    return float(deviations[0] @ deviations[1] / size) if size > 0.0 else np.nan
