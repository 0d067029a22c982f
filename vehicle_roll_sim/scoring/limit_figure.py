"""The figure of limits: where each test is first failed, over the spread."""

import math
from collections.abc import Sequence
from pathlib import Path

from vehicle_roll_sim.analysis.drawing import drawn_at, new_figure, printable, save_figure
from vehicle_roll_sim.analysis.pens import COLOURS
from vehicle_roll_sim.scoring.catalogue import TESTS, ScoredTest
from vehicle_roll_sim.scoring.results import Score
from vehicle_roll_sim.scoring.spread import NOMINAL

WIDTH, HEIGHT_OF_REST, HEIGHT_OF_ROW = 9.0, 0.9, 0.26
"""Inches: width of the figure; height of a panel without rows, and of a row."""
WITHOUT = "without"
BEYOND = 0.08
"""Where no failure is drawn: beyond the highest level, as a fraction of the range of levels."""


def write_limit_figure(path: Path, tests: Sequence[str], scores: Sequence[Score]) -> None:
    """One panel for each test: a line over the limits of all variants, a dot for the nominal one.

    A hollow dot, right of the last level, is no failure.
    """
    names = [WITHOUT, *(printable(score.controller) for score in scores)]
    height = len(tests) * (HEIGHT_OF_REST + HEIGHT_OF_ROW * len(names))
    figure = new_figure(WIDTH, height)
    with drawn_at(figure.scale):
        panels = figure.subplots(len(tests), 1, squeeze=False)[:, 0]
        for axes, name in zip(panels, tests, strict=True):
            _draw(axes, name, TESTS[name], scores, names)
    save_figure(figure, path)


def _draw(axes, name: str, test: ScoredTest, scores: Sequence[Score], names: Sequence[str]) -> None:
    levels = scores[0].of_test(name)[0].ladder.levels
    span = levels[-1] - levels[0] or levels[-1]
    none = levels[-1] + BEYOND * span
    rows = [
        (
            [climb.limit_alone for climb in scores[0].of_test(name)],
            [climb.limit_alone for climb in scores[0].of_test(name, NOMINAL)],
        ),
        *(
            (
                [climb.limit for climb in score.of_test(name)],
                [climb.limit for climb in score.of_test(name, NOMINAL)],
            )
            for score in scores
        ),
    ]
    for place, (every, nominal) in enumerate(rows):
        drawn = [min(limit, none) for limit in (min(every), max(every), min(nominal))]
        colour = COLOURS[place % len(COLOURS)]
        axes.plot(drawn[:2], [place, place], color=colour, linewidth=3, solid_capstyle="round")
        fill = "none" if math.isinf(min(nominal)) else colour
        axes.plot(drawn[2], place, "o", markersize=9, markerfacecolor=fill, color=colour)
    axes.set_yticks(range(len(names)))
    axes.set_yticklabels(names, parse_math=False)
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.set_xlim(levels[0] - BEYOND * span, none + BEYOND * span / 2)
    axes.set_xticks([*levels, none])
    axes.set_xticklabels([*(f"{level:g}" for level in levels), "none"])
    unit = f" ({test.unit})" if test.unit else ""
    axes.set_title(f"{test.title}: {test.limit}{unit}", loc="left", fontsize="medium")
    axes.grid(axis="x", alpha=0.4)
