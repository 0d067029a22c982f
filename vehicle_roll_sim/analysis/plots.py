"""The standard figure of one run, or of several runs overlaid."""

import dataclasses
import math
from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from vehicle_roll_sim.analysis.drawing import (
    POINTS_PER_INCH,
    DrawnFigure,
    add_legend,
    add_title,
    drawn_at,
    new_figure,
    save_figure,
)
from vehicle_roll_sim.analysis.figure_size import Size
from vehicle_roll_sim.analysis.panels import LOAD_TRANSFER, Signal, signals_of
from vehicle_roll_sim.analysis.pens import Pen, pens
from vehicle_roll_sim.analysis.road_shading import shade_road
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.derived_values import AXLES

STYLES_OF_WHEELS = ("-", "--", "-.", ":")
"""Line styles of commands by wheel; wheels with the same command share a line."""
WIDTH, HEIGHT_OF_SIGNAL, HEIGHT_OF_REST = 10.0, 1.35, 1.0
"""Inches: width of the figure, height of a signal's panel, and of title and legend together."""
REST_IN_PANELS = 0.75
"""Height of title and legend over that of a signal's panel."""
LONGEST_NAME = 9.6
"""Length of the longest axis label over its font size."""
KILO = 1e3
LEAST_SPAN = 0.1
"""Smallest range of a vertical axis, in its unit, so that rounding does not look like a signal."""
WHOLE_RATIO = (-1.05, 1.05)
"""Fixed axis range of the load transfer ratio."""
MARGIN = 0.02
"""Space after the last sample, as a fraction of the time range."""
HEADINGS = 12
"""Maximum number of heading arrows along a path."""
ARROW = {"pivot": "mid", "scale_units": "width", "scale": 24, "width": 0.006}
"""Arrow style; an arrow is a 24th of the panel's width long."""


@dataclasses.dataclass(frozen=True)
class DrawnRun:
    """A run to draw, with its EVENTS record, its label in the legend, and its road."""

    history: History
    events: np.record
    label: str = ""
    road: Road | None = None

    def shows(self, time: float) -> bool:
        """Whether the history covers a time (s; nan for never)."""
        return self.history["time"][0] <= time <= self.history["time"][-1]


def plot_run(
    history: History,
    events: np.record,
    path: Path,
    title: str,
    size: Size | None = None,
    road: Road | None = None,
) -> None:
    """Write the standard figure of one run; events: its EVENTS record."""
    save_figure(standard_figure([DrawnRun(history, events, road=road)], title, size), path)


def standard_figure(runs: Sequence[DrawnRun], title: str, size: Size | None = None) -> DrawnFigure:
    """Commands, roll, acceleration, yaw rate, sideslip, speed, normal loads, load transfer, path.

    Also the roll centres, for models in which they move.
    At most as many runs as there are COLOURS. The steering is always shown, other commands only if
    they are not 0 throughout. The panel of a wheel is shaded while it is off the ground, that of
    the path where the road of the first run is slippery, and has contour lines of its heights.
    size: size in print; by default the figure is made for a screen.
    """
    shown = signals_of(run.history for run in runs)
    figure = new_figure(WIDTH, HEIGHT_OF_REST + HEIGHT_OF_SIGNAL * len(shown), size)
    with drawn_at(figure.scale):
        _fill(figure, runs, shown)
        add_title(figure, title)
        pairs = zip(runs, pens(len(runs)), strict=True)
        named = [(pen.example(), run.label) for run, pen in pairs if run.label]
        add_legend(figure, [*named, *_marks(figure)])
    return figure


def _fill(figure: DrawnFigure, runs: Sequence[DrawnRun], shown: Sequence[Signal]) -> None:
    """Draw everything except title and legend."""
    signals, loads, path = _panels(figure, len(shown))
    begin = min(run.history["time"][0] for run in runs)
    end = max(run.history["time"][-1] for run in runs)
    headings = MaxNLocator(HEADINGS, steps=(1, 2, 5, 10)).tick_values(begin, end)
    for run, pen in zip(runs, pens(len(runs), figure.scale), strict=True):
        for axis, signal in zip(signals, shown, strict=True):
            _draw_signal(axis, signal, run, pen)
        _draw_loads(loads, run, pen)
        _draw_path(path, run, pen, headings)
    shade_road(path, runs[0].road, runs[0].history["x"], runs[0].history["y"])
    _label(signals, loads, path, runs)
    path.set_title(f"path, heading every {headings[1] - headings[0]:g} s", fontsize="medium")
    for axis in (*signals, *loads):
        axis.set_xlim(begin, end + MARGIN * max(end - begin, MARGIN))
    for axis in figure.axes:
        axis.grid(alpha=0.3)
        _widen(axis)
    for axis, signal in zip(signals, shown, strict=True):
        if signal is LOAD_TRANSFER:
            axis.set_ylim(*WHOLE_RATIO)
    _name(figure, signals, shown)


def _name(figure: DrawnFigure, signals, shown: Sequence[Signal]) -> None:
    """Label the panels at the side, or above them if they are too low for that."""
    height = figure.get_figheight() * POINTS_PER_INCH / (len(shown) + REST_IN_PANELS)
    is_low = height < LONGEST_NAME * matplotlib.rcParams["font.size"]
    for axis, signal in zip(signals, shown, strict=True):
        if is_low:
            axis.set_title(signal.label.replace("\n", " "), loc="left", fontsize="medium", pad=1.0)
        else:
            axis.set_ylabel(signal.label)
    if not is_low:
        figure.get_layout_engine().align(signals)


def _panels(figure: Figure, count: int) -> tuple:
    """Axes: signals on the left; on the right the wheels as seen from above, and the path."""
    left, right = figure.add_gridspec(1, 2, width_ratios=(1, 1.2))
    upper, lower = right.subgridspec(2, 1, height_ratios=(3, 2))
    signals = left.subgridspec(count, 1).subplots(sharex=True)
    loads = upper.subgridspec(2, 2).subplots(sharex=True, sharey=True)
    return signals, loads.flatten(), figure.add_subplot(lower)


def _draw_signal(axis, signal: Signal, run: DrawnRun, pen: Pen) -> None:
    time, values = run.history["time"], signal.of(run.history)
    if signal.is_command:
        _draw_command(axis, time, values, pen)
    elif signal.is_of_axles:
        _draw_axles(axis, time, values, pen)
    else:
        pen.draw(axis, time, values)
    _mark_rollover(axis, run, pen)


def _draw_command(axis, time: np.ndarray, values: np.ndarray, pen: Pen) -> None:
    """Draw one line for all wheels with the same command; a single line at 0 if there is none."""
    groups: dict[bytes, list[int]] = {}
    for wheel in range(len(WHEELS)):
        if np.nan_to_num(values[:, wheel]).any():
            groups.setdefault(values[:, wheel].tobytes(), []).append(wheel)
    for wheels in groups.values() or [[0]]:
        pen.draw(axis, time, values[:, wheels[0]], STYLES_OF_WHEELS[wheels[0]])
    for wheels in groups.values():
        names = "all wheels" if len(wheels) == len(WHEELS) else ", ".join(WHEELS[i] for i in wheels)
        style = STYLES_OF_WHEELS[wheels[0]]
        axis.plot([], [], style, color="black", linewidth=pen.width, label=f"command: {names}")


def _draw_axles(axis, time: np.ndarray, values: np.ndarray, pen: Pen) -> None:
    """Draw a line for each axle."""
    for name, style, of_axle in zip(AXLES, STYLES_OF_WHEELS, values.T, strict=False):
        pen.draw(axis, time, of_axle, style)
        axis.plot([], [], style, color="black", linewidth=pen.width, label=f"{name} axle")


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
        axis.axvline(
            rollover, color=pen.colour, linestyle=":", linewidth=pen.width, label="rollover"
        )


def _draw_path(axis, run: DrawnRun, pen: Pen, headings: np.ndarray) -> None:
    """Draw the path from above, with a heading arrow at each of the times `headings` (s)."""
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
    """Label axes and wheel panels; for a single run, also with the lift-off times."""
    for axis, wheel, lift_off in zip(loads, WHEELS, runs[0].events.lift_off_time, strict=True):
        lifts = len(runs) == 1 and not math.isnan(lift_off)
        axis.set_title(wheel + (f", lifts at {lift_off:.2f} s" if lifts else ""), fontsize="medium")
        axis.axhline(0.0, color="0.8", linewidth=0.8, zorder=1)  # the level of lift-off
    for axis in loads[::2]:
        axis.set_ylabel("tire normal force\n(kN)")
    for axis in (signals[-1], *loads[2:]):
        axis.set_xlabel("time (s)")
    path.set(xlabel="x (m)", ylabel="y (m)")
    path.set_aspect("equal", adjustable="datalim")


def _widen(axis) -> None:
    """Widen the vertical axis to at least LEAST_SPAN."""
    low, high = axis.get_ylim()
    if high - low < LEAST_SPAN:
        axis.set_ylim((low + high - LEAST_SPAN) / 2, (low + high + LEAST_SPAN) / 2)


def _marks(figure: Figure) -> list[tuple]:
    """(artist, name) of every kind of mark in the figure."""
    marks = {}
    for axis in figure.axes:
        for mark, name in zip(*axis.get_legend_handles_labels(), strict=True):
            marks.setdefault(name, mark)
    return [(mark, name) for name, mark in marks.items()]
