"""The standard figure shows what the samples say: every curve, every shade, every mark."""

import itertools
import math

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from vehicle_roll_sim import WHEELS
from vehicle_roll_sim.analysis.drawing import save_figure
from vehicle_roll_sim.analysis.metrics import load_transfer_ratio
from vehicle_roll_sim.analysis.plots import (
    COLOURS,
    DrawnRun,
    plot_run,
    standard_figure,
)
from vehicle_roll_sim.analysis.sampled_events import events_of
from vehicle_roll_sim.simulation.history import COLUMNS, History

pytestmark = pytest.mark.filterwarnings("error")
DEGREES = math.degrees(1)
SIGNALS = (
    ("steering", "(deg)", DEGREES),
    ("roll", "(deg)", DEGREES),
    ("lateral_acceleration", "(m/s²)", 1.0),
    ("yaw_rate", "(deg/s)", DEGREES),
)
SIGNAL_COUNT = len(SIGNALS) + 1
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


@pytest.fixture
def history() -> History:
    return recorded()


def panels(figure) -> tuple[list, list, object]:
    """Axes of the signals, of the loads and of the path."""
    axes = figure.axes
    return axes[:SIGNAL_COUNT], axes[SIGNAL_COUNT:-1], axes[-1]


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


def test_the_signals_are_those_of_the_samples_with_their_units(history):
    axes, _, _ = panels(standard_figure([drawn(history)], "run"))
    for axis, (name, unit, scale) in zip(axes, SIGNALS, strict=False):
        (curve,) = curves(axis)
        same(curve, history["time"], history[name] * scale)
        assert name.replace("_", " ").partition(" angle")[0] in axis.get_ylabel()
        assert unit in axis.get_ylabel()


def test_load_transfer_is_shown_from_one_side_to_the_other(history):
    axes, _, _ = panels(standard_figure([drawn(history)], "run"))
    (curve,) = curves(axes[-1])
    same(curve, history["time"], load_transfer_ratio(history.wheels("normal_force")))
    low, high = axes[-1].get_ylim()
    assert low < -1.0 < 1.0 < high
    assert "load transfer" in axes[-1].get_ylabel()


def test_every_wheel_has_its_load_in_its_place_and_all_have_the_same_scale(history):
    _, loads, _ = panels(standard_figure([drawn(history)], "run"))
    for axis, wheel in zip(loads, WHEELS, strict=True):
        (curve,) = curves(axis)
        same(curve, history["time"], history[f"normal_force_{wheel}"] / 1000)
        assert axis.get_title().startswith(wheel)
        assert axis.get_ylim() == loads[0].get_ylim()
    places = [axis.get_position() for axis in loads]
    assert places[0].y0 > places[2].y0  # front above rear
    assert places[0].x0 < places[1].x0  # left is left


def spans(shade) -> list[tuple[float, float]]:
    """First and last time of every shaded stretch."""
    ends = [path.vertices[:, 0] for path in shade.get_paths()]
    return [(min(x), max(x)) for x in ends]


def test_a_wheel_is_shaded_exactly_while_it_carries_no_load(history):
    _, loads, _ = panels(standard_figure([drawn(history)], "run"))
    time = history["time"]
    for axis, wheel in zip(loads, WHEELS, strict=True):
        shades = labelled(axis, "wheel off the ground")
        expected = [(time[first], time[last]) for first, last in LIFTS[wheel]]
        assert [span for shade in shades for span in spans(shade)] == expected


def test_lift_off_is_marked_where_the_events_have_it_and_in_words(history):
    run = drawn(history)
    _, loads, _ = panels(standard_figure([run], "run"))
    for axis, wheel, when in zip(loads, WHEELS, run.events.lift_off_time, strict=True):
        marks = labelled(axis, "lift-off")
        assert len(marks) == (0 if math.isnan(when) else 1)
        for mark in marks:
            same(mark, [when], [0.0])
        assert axis.get_title() == (f"{wheel}, lifts at {when:.2f} s" if marks else wheel)


@pytest.mark.parametrize("mirror", [1.0, -1.0], ids=["left", "right"])
def test_rollover_is_marked_in_every_panel_and_on_the_path(mirror):
    history = recorded(mirror=mirror)
    run = drawn(history)
    when = run.events.rollover_time[0]
    signals, loads, path = panels(standard_figure([run], "run"))
    for axis in (*signals, *loads):
        (mark,) = labelled(axis, "rollover")
        assert list(mark.get_xdata()) == [when, when]
    (mark,) = labelled(path, "rollover (path)")
    x, y = (np.interp(when, history["time"], history[name]) for name in ("x", "y"))
    same(mark, [x], [y])


def test_the_path_is_seen_from_above_with_the_heading_at_whole_times(history):
    _, _, path = panels(standard_figure([drawn(history)], "run"))
    (curve,) = curves(path)
    same(curve, history["x"], history["y"])
    assert path.get_aspect() == 1.0
    assert path.get_title() == "path, heading every 0.2 s"
    (arrows,) = (each for each in path.collections if hasattr(each, "angles"))
    every = slice(None, None, 2)
    np.testing.assert_allclose(arrows.X, history["x"][every])
    np.testing.assert_allclose(arrows.Y, history["y"][every])
    np.testing.assert_allclose(arrows.angles, np.degrees(history["yaw"][every]))


def test_the_legend_explains_what_is_there_and_nothing_else(history):
    assert set(shown_texts(standard_figure([drawn(history)], "run"))) == {
        *("wheel off the ground", "lift-off", "rollover", "rollover (path)")
    }
    calm = recorded(rolls_over=False)
    for quantity in ("normal_force", "tire_compression"):
        calm.wheels(quantity)[:] = 3000.0
    figure = standard_figure([drawn(calm)], "run")
    assert figure.legends == []
    assert not any("lifts" in axis.get_title() for axis in figure.axes)


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


def test_what_no_topic_or_model_has_is_said_and_the_rest_is_drawn(history, tmp_path):
    for name in ("yaw_rate", "z", "pitch", "normal_force_lr", "yaw"):
        history.rows[:, COLUMNS.index(name)] = np.nan
    figure = standard_figure([drawn(history)], "run")
    without = [axis for axis in figure.axes if any(t.get_text() == "no data" for t in axis.texts)]
    signals, loads, _ = panels(figure)
    assert without == [signals[3], signals[4], loads[2]]
    plot_run(history, events_of(history, ANGLE), tmp_path / "figure.png", "run")


def test_rounding_is_not_drawn_as_if_it_were_a_signal(history):
    history.rows[:, COLUMNS.index("steering")] = 1e-16 * np.sin(np.arange(SAMPLES))
    signals, _, _ = panels(standard_figure([drawn(history)], "run"))
    assert np.ptp(signals[0].get_ylim()) >= 0.1


@pytest.mark.parametrize("suffix", [".png", ".svg", ".pdf"])
@pytest.mark.parametrize("name", ["$\\frac$", "_hidden", "a\nb", "bad\udcff", "<&-->", ""])
def test_any_name_can_stand_in_a_figure(history, tmp_path, name, suffix):
    figure = standard_figure([drawn(history, name), drawn(history, "b")], name)
    save_figure(figure, tmp_path / f"figure{suffix}")
    if name.isprintable() and name:
        assert figure._suptitle.get_text() == name
        assert shown_texts(figure)[0] == name


@pytest.mark.parametrize("rows", [1, 2])
def test_few_samples_are_a_figure_too(history, tmp_path, rows):
    history.rows = history.rows[:rows]
    plot_run(history, events_of(history, ANGLE), tmp_path / "figure.png", "run")
    assert (tmp_path / "figure.png").stat().st_size > 0
