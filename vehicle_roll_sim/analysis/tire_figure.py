"""The standard figure of a tire: Fx, Fy and Mz over slip, and the envelope of combined forces."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.lines import Line2D

from vehicle_roll_sim.analysis.drawing import DrawnFigure, add_legend, add_title, new_figure
from vehicle_roll_sim.analysis.pens import COLOURS, LINE
from vehicle_roll_sim.analysis.tire_curves import Condition, CurveSet
from vehicle_roll_sim.vehicle.tire_file import Tire

WIDTH, HEIGHT = 11.0, 8.5
"""Inches."""
KILO = 1e3
DEGREES = math.degrees(1)
RANGE_ENDS = "limit of the file's range"
STYLES = ("-", "--", "-.", ":")
"""Line styles of inclinations and pressures; loads differ in colour."""
FAINT = {"color": "0.8", "linewidth": 0.8, "zorder": 1}
"""Style of the lines through zero."""
MIDDLE = {"xycoords": "axes fraction", "ha": "center", "color": "0.4"}


def tire_figure(curves: Sequence[CurveSet], tire: Tire, title: str) -> DrawnFigure:
    """The figure of at most as many loads as COLOURS, and as many other conditions as STYLES.

    A dotted line marks a limit of the file's slip range within a panel.
    """
    figure = new_figure(WIDTH, HEIGHT)
    axes = figure.subplots(2, 2).flatten()
    looks = looks_of([each.condition for each in curves])
    for each in curves:
        _draw(axes, each, looks[each.condition])
    _label(axes)
    if not any(each.lateral.forces.aligning_moment.any() for each in curves):
        axes[2].annotate("no coefficients in the file", (0.5, 0.55), **MIDDLE)
    _draw_ranges(axes, tire)
    add_title(figure, title)
    add_legend(figure, [*_loads(curves, looks), *_others(curves, looks), *_range_ends(axes)])
    return figure


def looks_of(conditions: Sequence[Condition]) -> dict[Condition, dict]:
    """Colour and line style of each condition."""
    loads = list(dict.fromkeys(each.normal_force for each in conditions))
    others = list(dict.fromkeys(_without_load(each) for each in conditions))
    return {
        each: {
            "color": COLOURS[loads.index(each.normal_force)],
            "linestyle": STYLES[others.index(_without_load(each))],
        }
        for each in conditions
    }


def _without_load(condition: Condition) -> tuple:
    return condition.inclination, condition.pressure


def _draw(axes, curves: CurveSet, look: dict) -> None:
    """Draw the curves of one condition in all panels."""
    style = look | {"linewidth": LINE}
    ahead, aside, around = curves.longitudinal, curves.lateral, curves.outline
    degrees = np.degrees(aside.slip_angle)
    axes[0].plot(ahead.slip_ratio, ahead.forces.longitudinal_force / KILO, **style)
    axes[1].plot(degrees, aside.forces.lateral_force / KILO, **style)
    axes[2].plot(degrees, aside.forces.aligning_moment, **style)
    combined = around.forces.longitudinal_force / KILO, around.forces.lateral_force / KILO
    axes[3].plot(*combined, **style)


def _label(axes) -> None:
    labels = (
        ("slip ratio κ (−)", "longitudinal force Fx (kN)", "zero slip angle"),
        ("slip angle α (deg)", "lateral force Fy (kN)", "zero slip ratio"),
        ("slip angle α (deg)", "aligning moment Mz (N m)", "zero slip ratio"),
        ("longitudinal force Fx (kN)", "lateral force Fy (kN)", "envelope of combined forces"),
    )
    for axis, (x, y, title) in zip(axes, labels, strict=True):
        axis.set(xlabel=x, ylabel=y)
        axis.set_title(title, fontsize="medium")
        axis.axhline(0.0, **FAINT)
        axis.axvline(0.0, **FAINT)
        axis.grid(alpha=0.3)
    axes[3].set_aspect("equal", adjustable="datalim")


def _draw_ranges(axes, tire: Tire) -> None:
    """Mark the limits of the file's slip ranges that are within the panels."""
    for axis, slip, scale in zip(axes, ("KPU", "ALP", "ALP"), (1.0, *2 * [DEGREES]), strict=False):
        low, high = axis.get_xlim()
        for end in ("MIN", "MAX"):
            place = tire.coefficients[slip + end] * scale
            if low < place < high:
                axis.axvline(place, color="0.5", linestyle=":", label=RANGE_ENDS)
        axis.set_xlim(low, high)


def _range_ends(axes) -> list[tuple]:
    """A legend entry for the range limits, if any is drawn."""
    drawn = [line for axis in axes for line in axis.lines if line.get_label() == RANGE_ENDS]
    return [(line, RANGE_ENDS) for line in drawn[:1]]


def _loads(curves: Sequence[CurveSet], looks: dict) -> list[tuple]:
    """A legend entry for each load."""
    named = {}
    for each in curves:
        entry = Line2D([], [], color=looks[each.condition]["color"])
        named.setdefault(f"{each.condition.normal_force:g} N", entry)
    return [(entry, name) for name, entry in named.items()]


def _others(curves: Sequence[CurveSet], looks: dict) -> list[tuple]:
    """A legend entry for each inclination and pressure, if there are several."""
    named = {}
    for each in curves:
        entry = Line2D([], [], color="0.4", linestyle=looks[each.condition]["linestyle"])
        named.setdefault(_in_words(each.condition), entry)
    return [(entry, name) for name, entry in named.items()] if len(named) > 1 else []


def _in_words(condition: Condition) -> str:
    angle = f"inclination {math.degrees(condition.inclination):.3g}°"
    if condition.pressure is None:
        return angle
    return f"{angle}, {condition.pressure / KILO:g} kPa"
