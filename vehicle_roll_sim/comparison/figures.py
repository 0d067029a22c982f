"""The figure of a comparison: measured over simulated with corridors, and cross plots."""

from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.drawing import add_legend, add_title, new_figure, save_figure
from vehicle_roll_sim.analysis.figure_size import Size
from vehicle_roll_sim.analysis.pens import COLOURS
from vehicle_roll_sim.comparison.comparison import STEERING, Compared, Judged, cross_corridor
from vehicle_roll_sim.comparison.report import shown_in
from vehicle_roll_sim.logs.quantities import ACCELERATION, QUANTITIES

MEASURED, SIMULATED, *_ = COLOURS
ROW, WIDTH = 2.1, 10.0
"""Inches: height of a quantity, and width of the figure."""


def draw(compared: Compared, path: Path, title: str, size: Size | None = None) -> None:
    """Write the figure in the format of the suffix of `path`.

    A row for each quantity: over time, and its cross plot: over the lateral acceleration where the
    log is quasi-steady, else measured over simulated.
    """
    rows = len(compared.judged) + (compared.steady is not None)
    figure = new_figure(WIDTH, ROW * rows + 1.0, size)
    panels = figure.subplots(rows, 2, squeeze=False, width_ratios=(2.2, 1.0))
    for (left, right), (name, judged) in zip(panels, compared.judged.items(), strict=False):
        entries = _over_time(left, name, judged, compared.time)
        if compared.steady is not None and name in compared.steady.inside:
            _over_acceleration(right, name, judged.measured, judged.simulated, compared)
        else:
            _over_simulated(right, name, judged, compared)
    panels[len(compared.judged) - 1, 0].set_xlabel("time (s)")
    if compared.steady is not None:
        panels[-1, 0].set_axis_off()
        angle = compared.driven.steering
        _over_acceleration(panels[-1, 1], STEERING, angle, angle, compared)
    add_title(figure, title)
    add_legend(figure, entries)
    save_figure(figure, path)


def _label(name: str) -> tuple[str, float]:
    unit, scale = shown_in(QUANTITIES[name].unit)
    return f"{name.replace('_', ' ')}\n({unit})", scale


def _over_time(axes, name: str, judged: Judged, time: np.ndarray) -> list[tuple]:
    label, scale = _label(name)
    band = axes.fill_between(time, scale * judged.lower, scale * judged.upper, color="0.85")
    (simulated,) = axes.plot(time, scale * judged.simulated, color=SIMULATED)
    (measured,) = axes.plot(time, scale * judged.measured, color=MEASURED, linewidth=0.8)
    axes.set_ylabel(label)
    axes.grid(alpha=0.3)
    return [(measured, "measured"), (simulated, "simulated"), (band, "corridor")]


def _over_simulated(axes, name: str, judged: Judged, compared: Compared) -> None:
    """Measured over simulated, with the tolerance of the value and no tolerance of time."""
    _, scale = _label(name)
    places = np.sort(judged.simulated)
    half = compared.tolerances.half_width(places, judged.agreement.peak)
    axes.fill_between(
        scale * places, scale * (places - half), scale * (places + half), color="0.85"
    )
    axes.plot(scale * places, scale * places, color=SIMULATED)
    axes.plot(
        scale * judged.simulated, scale * judged.measured, ".", color=MEASURED, markersize=1.5
    )
    axes.set(xlabel="simulated", ylabel="measured")
    axes.grid(alpha=0.3)


def _over_acceleration(
    axes, name: str, measured: np.ndarray, simulated: np.ndarray, compared: Compared
) -> None:
    """Measured points of the quasi-steady part over the lateral acceleration, in the corridor."""
    label, scale = _label(name)
    chosen, turn = compared.steady.chosen, compared.judged[ACCELERATION]
    along = turn.measured[chosen]
    lower, upper = cross_corridor(
        measured, simulated, turn.measured, turn.simulated, chosen, compared.tolerances
    )
    order = np.argsort(along, kind="stable")
    axes.fill_between(along[order], scale * lower[order], scale * upper[order], color="0.85")
    axes.plot(turn.simulated[chosen], scale * simulated[chosen], ".", color=SIMULATED, markersize=2)
    axes.plot(along, scale * measured[chosen], ".", color=MEASURED, markersize=1.5)
    axes.set(xlabel="lateral acceleration (m/s²)", ylabel=label)
    axes.grid(alpha=0.3)
