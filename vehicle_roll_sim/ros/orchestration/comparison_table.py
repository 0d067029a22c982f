"""The key figures of two runs of the same manoeuvre, side by side."""

import math

import numpy as np

from vehicle_roll_sim.analysis.panels import DEGREES, SIDESLIP
from vehicle_roll_sim.manoeuvres.criteria import has_wheel_heights
from vehicle_roll_sim.ros.orchestration.comparison import Outcome, distance

WITHOUT = "without"
COLUMN = 14
"""Width of the first column of figures (characters)."""


def comparison_table(without: Outcome, found: Outcome, name: str) -> list[str]:
    """Lines with the figures of both runs. name: heading of the run with controllers (`found`)."""
    end = min(without.end, found.end)
    pairs = [("", WITHOUT, name)]
    for label, of in MEASURES.items():
        pairs.append((f"{label}:", of(without), of(found)))
    pairs.append((f"until {end:.2f} s, when the first run ends", "", ""))
    for label, of in MEASURES_UNTIL.items():
        pairs.append((f"{label}:", of(without, end), of(found, end)))
    pairs.append(("largest distance:", f"{distance(without, found, end):.1f} m", ""))
    width = 2 + max(len(label) for label, *_ in pairs)
    return [f"{label:{width}}{one:{COLUMN}}{other}".rstrip() for label, one, other in pairs]


def _moment(time: float) -> str:
    return "none" if math.isnan(time) else f"{time:.2f} s"


def _two_wheel_lift(run: Outcome) -> str:
    return _moment(run.two_wheel_lift) if has_wheel_heights(run.history) else "unknown"


def _peak(values: np.ndarray, time: np.ndarray, end: float) -> str:
    return f"{np.degrees(np.nanmax(np.abs(values[time <= end]), initial=0.0)):.1f}"


def _peak_sideslip(run: Outcome, end: float) -> str:
    return f"{_peak(SIDESLIP.of(run.history) / DEGREES, run.history['time'], end)} deg"


def _peak_yaw_rate(run: Outcome, end: float) -> str:
    return f"{_peak(run.history['yaw_rate'], run.history['time'], end)} deg/s"


MEASURES = {
    "peak roll angle": lambda run: f"{run.peak_roll:.1f} deg",
    "largest load transfer ratio": lambda run: f"{run.largest_ratio:.2f}",
    "two-wheel lift": _two_wheel_lift,
    "rollover": lambda run: _moment(run.rollover),
}
"""Figures of whole runs."""
MEASURES_UNTIL = {
    "peak sideslip angle": _peak_sideslip,
    "peak yaw rate": _peak_yaw_rate,
    "forward speed at that time": lambda run, end: f"{run.at('u', end):.1f} m/s",
    "displacement to the left": lambda run, end: f"{run.at('y', end):.1f} m",
}
"""Figures of runs up to a time (s)."""
