"""The standard figure of a run, and what all figures share."""

import math
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.simulation.history import History
from vehicle_roll_sim.simulation.output_file import replaced_file

UNDATED = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
"""Metadata without which the same figure would differ from one run to the next."""
PANELS = (
    ("steering", "steering\n(deg)", math.degrees(1)),
    ("roll", "roll angle\n(deg)", math.degrees(1)),
    ("lateral_acceleration", "lateral acceleration\n(m/s²)", 1.0),
    ("yaw_rate", "yaw rate\n(deg/s)", math.degrees(1)),
)
COLOURS = ("tab:blue", "tab:orange", "tab:green", "tab:red")
KILO = 1e3
MARGIN = 0.02
"""Room after the last sample, as a share of the time shown."""


def new_figure(width: float, height: float) -> Figure:
    """An empty figure (inches), drawn without a screen."""
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def plot_run(history: History, events: np.record, path: Path, title: str) -> None:
    """Draw steering, roll, lateral acceleration, yaw rate and tire loads against time.

    events: the EVENTS record of the run; lift-offs and rollover are marked.
    """
    figure = new_figure(8.0, 11.0)
    axes = figure.subplots(len(PANELS) + 1, sharex=True, height_ratios=[1] * len(PANELS) + [2])
    time = history["time"]
    for axis, (name, label, scale) in zip(axes, PANELS, strict=False):
        axis.plot(time, history[name] * scale, color="black", linewidth=1.2)
        axis.set_ylabel(label)
    _draw_tire_loads(axes[-1], history, events)
    for axis in axes:
        axis.grid(alpha=0.3)
        if not math.isnan(events.rollover_time[0]):
            axis.axvline(events.rollover_time[0], color="tab:red", linestyle="--", linewidth=1)
    axes[0].set_title(title)
    axes[-1].set_xlabel("time (s); dashed: rollover")
    axes[-1].set_xlim(time[0], time[-1] + MARGIN * max(time[-1] - time[0], MARGIN))
    figure.align_ylabels()
    save_figure(figure, path)


def save_figure(figure: Figure, path: Path) -> None:
    """Write a figure in the format of its name, the same bytes for the same figure."""
    with replaced_file(path) as partial, matplotlib.rc_context({"svg.hashsalt": "run"}):
        figure.savefig(partial, dpi=110, metadata=UNDATED.get(path.suffix.lower()))


def _draw_tire_loads(axis, history: History, events: np.record) -> None:
    """Tire loads, with a mark where a wheel first lifts off."""
    loads = history.wheels("normal_force") / KILO
    for load, wheel, colour, lift_off in zip(
        loads.T, WHEELS, COLOURS, events.lift_off_time, strict=True
    ):
        lifted = "" if math.isnan(lift_off) else f", lifts at {lift_off:.2f} s"
        axis.plot(history["time"], load, color=colour, linewidth=1.2, label=wheel + lifted)
        axis.plot([lift_off], [0.0], "o", color=colour)
    axis.set_ylabel("tire normal force\n(kN)")
    axis.legend(loc="upper left", fontsize="small")
