"""Pass/fail criteria of the standards, evaluated from the history of a run."""

import math

import numpy as np

from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import two_wheel_lift_time

ROUNDING = 1e-9
"""s"""


def two_wheel_lift(history: History) -> float:
    """Time (s) of the first sample with both wheels of one side at least 2 inches off the ground.

    nan if there is none, or if the heights of the wheels are unknown.
    """
    return two_wheel_lift_time(history["time"], history.wheel_lift())


def has_wheel_heights(history: History) -> bool:
    """Whether the heights of the wheels above the ground are known."""
    return not np.isnan(history.wheel_lift()).all()


def two_wheel_lift_line(history: History) -> dict[str, str]:
    """The line on two-wheel lift in the summary of a run."""
    if not has_wheel_heights(history):
        return {"two-wheel lift": "unknown: no heights of the wheels"}
    time = two_wheel_lift(history)
    return {"two-wheel lift": "none" if math.isnan(time) else f"{time:.3f} s"}


def value_at(history: History, name: str, time: float) -> float:
    """A signal at a time (s), interpolated linearly; nan after the end of the run."""
    if time > history["time"][-1] + ROUNDING:
        return math.nan
    return float(np.interp(time, history["time"], history[name]))
