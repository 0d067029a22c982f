"""Runs with known samples, and readers of the figures drawn from them."""

import math

import numpy as np

from vehicle_roll_sim.analysis.plots import DrawnRun
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.sampled_events import events_of

DEGREES = math.degrees(1)
SIGNALS = (
    ("steering", "(deg)", DEGREES),
    ("roll", "(deg)", DEGREES),
    ("lateral_acceleration", "(m/s²)", 1.0),
    ("yaw_rate", "(deg/s)", DEGREES),
)
SAMPLES = 21
ANGLE = 1.0
"""rad of roll that counts as rolled over."""
LIFTS = {"lf": [(3, 8), (12, 20)], "rf": [], "lr": [(5, 5)], "rr": [(18, 20)]}
"""First and last sample of every time that a wheel carries no load."""


def recorded(rolls_over: bool = True, mirror: float = 1.0) -> History:
    """Samples of smooth signals, each another one; wheels lift as `LIFTS` has it."""
    rows = np.arange(float(SAMPLES))[:, np.newaxis] / 10 + np.arange(len(COLUMNS))
    rows = mirror * np.sin(rows)
    rows[:, 0] = np.arange(SAMPLES) / 10
    rows[:, COLUMNS.index("roll")] *= 0.4
    if rolls_over:
        rows[:, COLUMNS.index("roll")] = mirror * np.linspace(0.0, 1.2, SAMPLES)
    for wheel, spans in LIFTS.items():
        load = rows[:, COLUMNS.index(f"normal_force_{wheel}")]
        load[:] = 3000.0 + 500.0 * load
        for first, last in spans:
            load[first : last + 1] = 0.0
        compression = rows[:, COLUMNS.index(f"tire_compression_{wheel}")]
        compression[:] = np.where(load > 0.0, load, -1.0)
    return History(rows)


def drawn(history: History, label: str = "") -> DrawnRun:
    return DrawnRun(history, events_of(history, ANGLE), label)


def panels(figure) -> tuple[list, list, object]:
    """Axes of the signals, of the loads and of the path."""
    axes = figure.axes
    return axes[:-5], axes[-5:-1], axes[-1]


def curves(axis) -> list:
    """What was drawn of the samples, and not of an event."""
    return [line for line in axis.lines if len(line.get_xdata()) == SAMPLES]


def labelled(axis, label: str) -> list:
    return [each for each in axis.get_children() if each.get_label() == label]


def shown_texts(figure) -> list[str]:
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def same(curve, x, y) -> None:
    np.testing.assert_array_equal(curve.get_xdata(), x)
    np.testing.assert_array_equal(curve.get_ydata(), y)
