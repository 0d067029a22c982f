"""The standard figure of one run, or of several over each other."""

import dataclasses
import itertools
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from vehicle_roll_sim.analysis.drawing import add_legend, add_title, new_figure, save_figure
from vehicle_roll_sim.analysis.metrics import load_transfer_ratio
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.simulation.history import History

PANELS = (
    ("steering", "steering\n(deg)", math.degrees(1)),
    ("roll", "roll angle\n(deg)", math.degrees(1)),
    ("lateral_acceleration", "lateral acceleration\n(m/s²)", 1.0),
    ("yaw_rate", "yaw rate\n(deg/s)", math.degrees(1)),
)
COLOURS = ("black", "#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00")
"""Of the runs; those of Okabe and Ito, which the colour-blind can tell apart."""
STYLES = ("-", "--", "-.")
KILO = 1e3
LEAST_SPAN = 0.1
"""Of a vertical axis, in its unit: less is rounding, and not drawn as if it were a signal."""
WHOLE_RATIO = (-1.05, 1.05)
"""What is shown of the load transfer ratio, whatever it is."""
MARGIN = 0.02
"""Room after the last sample, as a share of the time shown."""
MARKER = 5
"""Points."""
HEADINGS = 12
"""Times along a path, at most."""
ARROW = {"pivot": "mid", "scale_units": "width", "scale": 24, "width": 0.006}
"""A 24th of the panel's width."""


@dataclasses.dataclass(frozen=True)
class DrawnRun:
    """A run with its EVENTS record, and what it is called beside others."""

    history: History
    events: np.record
    label: str = ""

    def shows(self, time: float) -> bool:
        """Whether a time (s), nan for never, is one of those that the history covers."""
        return self.history["time"][0] <= time <= self.history["time"][-1]


@dataclasses.dataclass(frozen=True)
class Pen:
    """How a run is drawn; `band` is the share of a panel's height that it may shade."""

    colour: str
    style: str
    band: tuple[float, float]

    def example(self) -> Line2D:
        """A line for a legend."""
        return Line2D([], [], linestyle=self.style, color=self.colour)

    def draw(self, axis, x: np.ndarray, y: np.ndarray) -> None:
        """A line, or the word that there is none."""
        axis.plot(x, y, self.style, color=self.colour, linewidth=1.3)
        if np.isnan(y).all():
            about = {"color": self.colour, "ha": "center", "va": "center"}
            axis.text(0.5, sum(self.band) / 2, "no data", transform=axis.transAxes, **about)

    def shade(self, axis, x: np.ndarray, where: np.ndarray, label: str) -> None:
        height = axis.get_xaxis_transform()
        shade = axis.fill_between(x, *self.band, where=where, transform=height, label=label)
        shade.set(color=self.colour, alpha=0.13)

    def mark(self, axis, x: float, y: float, marker: str, label: str) -> None:
        axis.plot(x, y, marker, color=self.colour, markersize=MARKER, label=label)


def pens(count: int) -> list[Pen]:
    """One for each run; their bands lie one above the other, that of the first run at the top."""
    looks = zip(COLOURS, itertools.cycle(STYLES), strict=False)
    return [
        Pen(*look, (1 - (place + 1) / count, 1 - place / count))
        for place, look in zip(range(count), looks, strict=False)
    ]


def plot_run(history: History, events: np.record, path: Path, title: str) -> None:
    """Write the standard figure of one run; events: its EVENTS record."""
    save_figure(standard_figure([DrawnRun(history, events)], title), path)


def standard_figure(runs: Sequence[DrawnRun], title: str) -> Figure:
    """Steering, roll, lateral acceleration, yaw rate, load transfer, tire loads and path.

    As many runs as there are `COLOURS`. The panel of a wheel is shaded while it carries no load.
    """
    figure = new_figure(10.0, 9.0)
    signals, loads, path = panels = _panels(figure)
    begin = min(run.history["time"][0] for run in runs)
    end = max(run.history["time"][-1] for run in runs)
    headings = MaxNLocator(HEADINGS, steps=(1, 2, 5, 10)).tick_values(begin, end)
    drawn = list(zip(runs, pens(len(runs)), strict=True))
    for run, pen in drawn:
        _draw_signals(signals, run, pen)
        _draw_loads(loads, run, pen)
        _draw_path(path, run, pen, headings)
    _label(*panels, runs)
    path.set_title(f"path, heading every {headings[1] - headings[0]:g} s", fontsize="medium")
    for axis in (*signals, *loads):
        axis.set_xlim(begin, end + MARGIN * max(end - begin, MARGIN))
    for axis in figure.axes:
        axis.grid(alpha=0.3)
        _widen(axis)
    signals[-1].set_ylim(*WHOLE_RATIO)
    figure.align_ylabels(signals)
    add_title(figure, title)
    named = [(pen.example(), run.label) for run, pen in drawn if run.label]
    add_legend(figure, [*named, *_marks(figure)])
    return figure


def _panels(figure: Figure) -> tuple:
    """Axes: signals on the left; on the right those of the wheels as seen from above, and path."""
    left, right = figure.add_gridspec(1, 2, width_ratios=(1, 1.2))
    upper, lower = right.subgridspec(2, 1, height_ratios=(3, 2))
    signals = left.subgridspec(len(PANELS) + 1, 1).subplots(sharex=True)
    loads = upper.subgridspec(2, 2).subplots(sharex=True, sharey=True)
    return signals, loads.flatten(), figure.add_subplot(lower)


def _draw_signals(axes, run: DrawnRun, pen: Pen) -> None:
    signals = [run.history[name] * scale for name, _, scale in PANELS]
    signals.append(load_transfer_ratio(run.history.wheels("normal_force")))
    for axis, signal in zip(axes, signals, strict=True):
        pen.draw(axis, run.history["time"], signal)
        _mark_rollover(axis, run, pen)


def _draw_loads(axes, run: DrawnRun, pen: Pen) -> None:
    time, loads = run.history["time"], run.history.wheels("normal_force").T
    for axis, load, lift_off in zip(axes, loads, run.events.lift_off_time, strict=True):
        pen.draw(axis, time, load / KILO)
        _mark_rollover(axis, run, pen)
        if (load == 0.0).any():
            pen.shade(axis, time, load == 0.0, "wheel off the ground")
        if run.shows(lift_off):
            pen.mark(axis, lift_off, 0.0, "o", "lift-off")


def _mark_rollover(axis, run: DrawnRun, pen: Pen) -> None:
    rollover = run.events.rollover_time[0]
    if run.shows(rollover):
        axis.axvline(rollover, color=pen.colour, linestyle=":", linewidth=1.3, label="rollover")


def _draw_path(axis, run: DrawnRun, pen: Pen, headings: np.ndarray) -> None:
    """The path from above, with an arrow at each of the times `headings` (s)."""
    time, rollover = run.history["time"], run.events.rollover_time[0]
    pen.draw(axis, run.history["x"], run.history["y"])
    when = [each for each in headings if run.shows(each)]
    x, y, yaw = (np.interp(when, time, run.history[name]) for name in ("x", "y", "yaw"))
    length = np.ones(len(when)), np.zeros(len(when))
    axis.quiver(x, y, *length, angles=np.degrees(yaw), color=pen.colour, **ARROW)
    if run.shows(rollover):
        x, y = (np.interp(rollover, time, run.history[name]) for name in ("x", "y"))
        pen.mark(axis, x, y, "x", "rollover (path)")


def _label(signals, loads, path, runs: Sequence[DrawnRun]) -> None:
    """Names and units; of a single run also when its wheels lift."""
    labels = [*(label for _, label, _ in PANELS), "load transfer\nratio (−)"]
    for axis, label in zip(signals, labels, strict=True):
        axis.set_ylabel(label)
    for axis, wheel, lift_off in zip(loads, WHEELS, runs[0].events.lift_off_time, strict=True):
        lifts = len(runs) == 1 and not math.isnan(lift_off)
        axis.set_title(wheel + (f", lifts at {lift_off:.2f} s" if lifts else ""), fontsize="medium")
        axis.axhline(0.0, color="0.8", linewidth=0.8, zorder=1)  # how far it is from lifting
    for axis in loads[::2]:
        axis.set_ylabel("tire normal force\n(kN)")
    for axis in (signals[-1], *loads[2:]):
        axis.set_xlabel("time (s)")
    path.set(xlabel="x (m)", ylabel="y (m)")
    path.set_aspect("equal", adjustable="datalim")


def _widen(axis) -> None:
    """Show no less than `LEAST_SPAN`."""
    low, high = axis.get_ylim()
    if high - low < LEAST_SPAN:
        axis.set_ylim((low + high - LEAST_SPAN) / 2, (low + high + LEAST_SPAN) / 2)


def _marks(figure: Figure) -> list[tuple]:
    """(artist, name) of every kind of mark that there is."""
    marks = {}
    for axis in figure.axes:
        for mark, name in zip(*axis.get_legend_handles_labels(), strict=True):
            marks.setdefault(name, mark)
    return [(mark, name) for name, mark in marks.items()]
