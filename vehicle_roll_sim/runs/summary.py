"""The summary printed at the end of a run."""

import math

import numpy as np

from vehicle_roll_sim.model.integration.events import MINIMUM_SPEED, TIME, VALUE, Condition
from vehicle_roll_sim.model.records import WHEELS

RANGES = ("slip ratio", "slip angle", "tire load")
LABEL_WIDTH = 28


def summary_lines(events: np.record, time: float, condition: Condition, note: str = "") -> list:
    """Peaks, lift-offs, rollover and how the run ended, one line each.

    events: an EVENTS record. time: end of the run (s). note: the implausible state if it diverged.
    """
    roll, acceleration = events.peak_roll, events.peak_lateral_acceleration
    lift_offs = zip(WHEELS, events.lift_off_time, strict=True)
    return [
        line("peak roll angle", _peak(np.degrees(roll[VALUE]), "deg", roll)),
        line("peak lateral acceleration", _peak(acceleration[VALUE], "m/s^2", acceleration)),
        *(line(f"lift-off {wheel}", _time(time)) for wheel, time in lift_offs),
        line("rollover", _time(events.rollover_time[0])),
        *_ranges_left(events),
        line("end", f"{time:.3f} s, {_ending(condition, note)}"),
    ]


def line(label: str, value) -> str:
    """A line of the summary: label, colon and value."""
    return f"{label + ':':{LABEL_WIDTH}}{value}"


def _time(value: float) -> str:
    return "none" if math.isnan(value) else f"{value:.3f} s"


def _peak(value: float, unit: str, peak: np.ndarray) -> str:
    when = f" at {peak[TIME]:.3f} s" if peak[VALUE] else ""
    return f"{value:.3f} {unit}{when}"


def _ranges_left(events: np.record):
    for quantity, time in zip(RANGES, events.out_of_range_time, strict=True):
        if not math.isnan(time):
            note = f"from {time:.3f} s: outside the range of the tire file"
            yield line(f"{quantity} out of range", note)


def _ending(condition: Condition, note: str) -> str:
    if condition is Condition.ROLLED_OVER:
        return "rolled over"
    if condition is Condition.TOO_SLOW:
        return f"too slow: the speed fell to {MINIMUM_SPEED:g} m/s, the minimum of the model"
    if condition is Condition.DIVERGED:
        cause = "unrealistic torques, forces or parameters, or too large a step"
        return f"diverged: {note} is not plausible ({cause})"
    return "complete"
