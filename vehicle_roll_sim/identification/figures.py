"""The figure of a profile likelihood."""

from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.drawing import add_legend, add_title, new_figure, save_figure
from vehicle_roll_sim.analysis.figure_size import Size
from vehicle_roll_sim.analysis.pens import COLOURS
from vehicle_roll_sim.identification.profile import LIMIT, Profile

FIRST, SECOND, *_ = COLOURS
WIDTH, HEIGHT = 6.0, 4.0
"""Inches"""


def draw(found: Profile, path: Path, title: str = "", size: Size | None = None) -> None:
    """Write the figure in the format of the suffix of `path`: deviance over the value."""
    figure = new_figure(WIDTH, HEIGHT, size)
    axes = figure.subplots()
    along = np.linspace(found.values[0], found.values[-1], 101)
    parabola = ((along - found.estimate) / found.error) ** 2
    (by_errors,) = axes.plot(along, parabola, color=SECOND, linewidth=0.8)
    (profile,) = axes.plot(found.values, found.deviances, "o-", color=FIRST, markersize=3)
    limit = axes.axhline(LIMIT, color="0.5", linestyle="--", linewidth=0.8)
    axes.set(
        xlabel=f"{found.name} ({found.unit})" if found.unit else found.name,
        ylabel="deviance",
        ylim=(0.0, max(10.0, float(found.deviances.max()) * 1.05)),
    )
    axes.grid(alpha=0.3)
    add_title(figure, title)
    entries = [
        (profile, "profile"),
        (by_errors, "parabola of the standard error"),
        (limit, "limit of 95 %"),
    ]
    add_legend(figure, entries)
    save_figure(figure, path)
