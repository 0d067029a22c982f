"""The standard figure shows the samples: every curve, shaded interval and mark."""

import math

import matplotlib
import numpy as np
import pytest
from drawn_runs import (
    ANGLE,
    LIFTS,
    SAMPLES,
    SIGNALS,
    curves,
    drawn,
    labelled,
    panels,
    recorded,
    same,
    shown_texts,
)
from matplotlib.axes import Axes
from matplotlib.layout_engine import ConstrainedLayoutEngine

from vehicle_roll_sim import WHEELS
from vehicle_roll_sim.analysis.drawing import DrawnFigure, save_figure
from vehicle_roll_sim.analysis.plots import plot_run, standard_figure
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import load_transfer_ratio, sideslip_angle
from vehicle_roll_sim.runs.sampled_events import events_of

pytestmark = [pytest.mark.filterwarnings("error"), pytest.mark.unmeasured]


@pytest.fixture
def history() -> History:
    return recorded()


def test_the_signals_are_those_of_the_samples_with_their_units(history):
    axes, _, _ = panels(standard_figure([drawn(history)], "run"))
    for axis, (name, unit, scale) in zip(axes, SIGNALS, strict=False):
        (curve,) = curves(axis)
        same(curve, history["time"], history[name] * scale)
        assert name.replace("_", " ").partition(" angle")[0] in axis.get_ylabel()
        assert unit in axis.get_ylabel()


def test_steering_is_said_to_be_that_of_the_front_road_wheels(history):
    axes, _, _ = panels(standard_figure([drawn(history)], "run"))
    assert axes[0].get_ylabel() == "steering, front\nroad wheels (deg)"


def test_sideslip_and_speed_are_shown(history):
    axes, _, _ = panels(standard_figure([drawn(history)], "run"))
    sideslip, speed = axes[-3:-1]
    assert sideslip.get_ylabel() == "sideslip angle\n(deg)"
    velocity = [history[name] for name in "uvw"]
    angle = sideslip_angle(velocity, history["roll"], history["pitch"])
    same(curves(sideslip)[0], history["time"], np.degrees(1) * angle)
    assert speed.get_ylabel() == "forward speed\n(m/s)"
    same(curves(speed)[0], history["time"], history["u"])


def test_load_transfer_is_shown_from_one_side_to_the_other(history):
    axes, _, _ = panels(standard_figure([drawn(history)], "run"))
    (curve,) = curves(axes[-1])
    same(curve, history["time"], load_transfer_ratio(history.wheels("normal_force")))
    low, high = axes[-1].get_ylim()
    assert low < -1.0 < 1.0 < high
    assert "load transfer" in axes[-1].get_ylabel()


def test_roll_centres_that_move_are_shown_for_each_axle_up_to_2_m(history):
    rows = np.linspace(-3.0, 3.0, SAMPLES)[:, np.newaxis] + [0.0, 0.1, 0.2, 0.3]
    history.roll_centres = rows
    axes, _, _ = panels(standard_figure([drawn(history)], "run"))
    for axis, label, columns in zip(
        axes[-2:], ("height", "to the left"), ((0, 1), (2, 3)), strict=True
    ):
        assert "roll centre" in axis.get_ylabel()
        assert label in axis.get_ylabel()
        for curve, column in zip(curves(axis), columns, strict=True):
            values = rows[:, column]
            same(curve, history["time"], np.where(np.abs(values) <= 2.0, values, np.nan))
    assert {"front axle", "rear axle"} <= {*shown_texts(axes[-1].figure)}


def test_the_labels_of_signals_stand_one_below_the_other_beside_the_widest_ticks(history):
    history.rows[:, COLUMNS.index("lateral_acceleration")] *= 1e4
    figure = standard_figure([drawn(history)], "run")
    signals, _, _ = panels(figure)
    for _ in range(2):  # drawn again, they stay
        figure.draw_without_rendering()
        places = [axis.yaxis.label.get_window_extent().x1 for axis in signals]
        ticks = [text.get_window_extent().x0 for axis in signals for text in axis.get_yticklabels()]
        assert np.ptp(places) < 1.0  # pixels, of letters that reach below the line
        pad = signals[0].figure.dpi / 72 * matplotlib.rcParams["axes.labelpad"]
        assert min(ticks) - max(places) == pytest.approx(pad, abs=1.0)


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


def test_what_no_topic_or_model_has_is_said_and_the_rest_is_drawn(history, tmp_path):
    for name in ("yaw_rate", "z", "pitch", "normal_force_lr", "yaw"):
        history.rows[:, COLUMNS.index(name)] = np.nan
    figure = standard_figure([drawn(history)], "run")
    without = [axis for axis in figure.axes if any(t.get_text() == "no data" for t in axis.texts)]
    signals, loads, _ = panels(figure)
    assert without == [signals[3], signals[-1], loads[2]]
    plot_run(history, events_of(history, ANGLE), tmp_path / "figure.png", "run")


def test_rounding_is_not_drawn_as_if_it_were_a_signal(history):
    history.rows[:, COLUMNS.index("steering")] = 1e-16 * np.sin(np.arange(SAMPLES))
    signals, _, _ = panels(standard_figure([drawn(history)], "run"))
    assert np.ptp(signals[0].get_ylim()) >= 0.1


ODD = ("$\\frac$", "_hidden", "a\nb", "bad\udcff", "<&-->", "")
"""Names of runs."""


@pytest.mark.parametrize("suffix", [".png", ".svg", ".pdf"])
def test_any_name_can_stand_in_a_figure(history, tmp_path, suffix):
    path = tmp_path / f"figure{suffix}"
    save_figure(standard_figure([drawn(history, name) for name in ODD], "".join(ODD)), path)
    assert path.stat().st_size > 1000


@pytest.mark.parametrize("name", [name for name in ODD if name.isprintable() and name])
def test_a_title_is_shown_as_it_is(history, name):
    figure = standard_figure([drawn(history, name), drawn(history, "b")], name)
    assert figure._suptitle.get_text() == name
    assert shown_texts(figure)[0] == name


@pytest.mark.parametrize("rows", [1, 2])
def test_few_samples_are_a_figure_too(history, tmp_path, rows):
    history.rows = history.rows[:rows]
    plot_run(history, events_of(history, ANGLE), tmp_path / "figure.png", "run")
    assert (tmp_path / "figure.png").stat().st_size > 0


@pytest.fixture
def contents(history, tmp_path):
    """Writes the figure as SVG; its bytes."""
    path = tmp_path / "figure.svg"

    def write() -> bytes:
        plot_run(history, events_of(history, ANGLE), path, "run")
        return path.read_bytes()

    return write


@pytest.fixture(scope="module")
def as_it_is() -> list[bytes]:
    """The bytes of that figure, once a test has drawn it."""
    return []


def test_drawn_once_it_has_the_bytes_of_matplotlibs_two_drawings(contents, as_it_is, monkeypatch):
    drawn_axes, draw = [], Axes.draw
    note = lambda axes, renderer: (drawn_axes.append(axes), draw(axes, renderer))  # noqa: E731
    monkeypatch.setattr(Axes, "draw", note)
    as_it_is.append(contents())
    count = len(drawn_axes)
    assert count == len({*drawn_axes}) > 4
    monkeypatch.delattr(DrawnFigure, "draw")
    assert contents() == as_it_is[0]
    assert len(drawn_axes) == count + 2 * count


def test_the_last_bits_of_the_layout_do_not_reach_the_file(contents, as_it_is, monkeypatch):
    """They differ from run to run; here by more than they do."""
    lay_out = ConstrainedLayoutEngine.execute

    def nudge(engine, figure):
        lay_out(engine, figure)
        for axes in figure.axes:
            bounds = np.array(axes.get_position(original=True).bounds)
            axes.set_position(bounds + 1e-13)
            axes.set_in_layout(True)

    as_solved = as_it_is[0] if as_it_is else contents()
    monkeypatch.setattr(ConstrainedLayoutEngine, "execute", nudge)
    assert contents() == as_solved
