"""The standard figure of several runs: curves can be distinguished and none is hidden."""

import itertools

import numpy as np
import pytest
from drawn_runs import DEGREES, curves, drawn, labelled, panels, recorded, same, shown_texts
from matplotlib.colors import to_rgb

from vehicle_roll_sim import WHEELS
from vehicle_roll_sim.analysis.pens import COLOURS
from vehicle_roll_sim.analysis.plots import standard_figure
from vehicle_roll_sim.runs.history import History

pytestmark = pytest.mark.filterwarnings("error")


def load_of_rr(history: History) -> np.ndarray:
    """kN"""
    return history["normal_force_rr"] / 1000


def test_runs_are_told_apart_by_colour_and_style_and_named_in_the_legend():
    names = [f"run {i}" for i in range(len(COLOURS))]
    histories = [recorded(rolls_over=i % 2 == 0, mirror=(-1.0) ** i) for i in range(len(names))]
    runs = [drawn(*each) for each in zip(histories, names, strict=True)]
    figure = standard_figure(runs, "all")
    assert shown_texts(figure)[: len(names)] == names
    signals, loads, _ = panels(figure)
    for axis, shown in ((signals[1], lambda h: h["roll"] * DEGREES), (loads[3], load_of_rr)):
        found = curves(axis)
        for curve, run, colour in zip(found, runs, COLOURS, strict=True):
            same(curve, run.history["time"], shown(run.history))
            assert to_rgb(curve.get_color()) == to_rgb(colour)
        assert len({(each.get_color(), each.get_linestyle()) for each in found}) == len(runs)
        neighbours = itertools.pairwise(found)
        assert all(one.get_linestyle() != other.get_linestyle() for one, other in neighbours)
    assert [axis.get_title() for axis in loads] == list(WHEELS)


def test_shades_of_several_runs_do_not_cover_each_other():
    runs = [drawn(recorded(), "one"), drawn(recorded(), "other")]
    _, loads, _ = panels(standard_figure(runs, ""))
    one, other = labelled(loads[0], "wheel off the ground")
    heights = [[path.vertices[:, 1] for path in shade.get_paths()] for shade in (one, other)]
    assert {(min(y), max(y)) for y in heights[0]} == {(0.5, 1.0)}
    assert {(min(y), max(y)) for y in heights[1]} == {(0.0, 0.5)}


def test_time_reaches_from_the_first_sample_of_any_run_to_the_last():
    late, short = recorded(), recorded()
    late.rows[:, 0] += 1.0
    short.rows = short.rows[:5]
    figure = standard_figure([drawn(short, "short"), drawn(late, "late")], "")
    for axis in figure.axes[:-1]:
        begin, end = axis.get_xlim()
        assert begin == 0.0
        assert 3.0 < end < 3.2
