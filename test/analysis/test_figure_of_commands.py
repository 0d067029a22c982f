"""The standard figure shows every command and has the requested size."""

import itertools

import numpy as np
import pytest
from drawn_runs import SAMPLES, curves, drawn, panels, recorded, same, shown_texts
from matplotlib.image import imread

from vehicle_roll_sim import WHEELS, InputError
from vehicle_roll_sim.analysis.drawing import drawn_at, save_figure
from vehicle_roll_sim.analysis.figure_size import named_size
from vehicle_roll_sim.analysis.plots import standard_figure
from vehicle_roll_sim.runs.columns import COMMANDS
from vehicle_roll_sim.runs.history import History

pytestmark = [pytest.mark.filterwarnings("error"), pytest.mark.unmeasured]

RISING = np.linspace(0.0, 1.0, SAMPLES)
FORCES = {f"active_force_{wheel}": (k + 1) * RISING for k, wheel in enumerate(WHEELS)}
WRONG_SIZES = (
    *("", "170", "170x", "170x200mm", "nanxnan", "1e3x200", "-170x200"),
    *("79x200", "170x119", "170x1001", "1001x200"),
)


def commanded(**commands) -> History:
    """Samples with the commands that are given, by name, and no others."""
    history = recorded()
    history.commands = np.zeros((SAMPLES, len(COMMANDS)))
    for name, values in commands.items():
        history.commands[:, COMMANDS.index(name)] = values
    return history


def test_commands_are_shown_where_they_are_not_0_each_wheel_by_its_style():
    torque = {"wheel_torque_lr": 50 * RISING, "wheel_torque_rr": 50 * RISING}
    history = commanded(**torque, brake_torque_rf=80 * RISING, rear_steering=-0.1 * RISING)
    figure = standard_figure([drawn(history)], "run")
    signals, _, _ = panels(figure)
    labels = [axis.get_ylabel().partition("\n")[0] for axis in signals[:5]]
    expected = ["steering, front", "steering, rear", "wheel torque", "brake torque", "roll angle"]
    assert labels == expected
    same(curves(signals[1])[0], history["time"], np.degrees(1) * history.command("rear_steering"))
    (driven,) = curves(signals[2])  # both have the same
    same(driven, history["time"], 50 * RISING)
    (braked,) = curves(signals[3])
    assert driven.get_linestyle() != braked.get_linestyle()
    assert {"command: lr, rr", "command: rf"} < set(shown_texts(figure))


def test_commands_of_every_wheel_are_told_apart_and_equal_ones_are_named_once():
    signals, _, _ = panels(standard_figure([drawn(commanded(**FORCES))], "run"))
    assert len({curve.get_linestyle() for curve in curves(signals[1])}) == len(WHEELS)
    figure = standard_figure([drawn(commanded(**dict.fromkeys(FORCES, RISING)))], "run")
    assert len(curves(panels(figure)[0][1])) == 1
    assert "command: all wheels" in shown_texts(figure)


def test_of_several_runs_one_without_the_command_has_a_line_at_0_and_unknown_is_said():
    braked, free, unknown = commanded(brake_torque_lf=RISING), commanded(), recorded()
    runs = [drawn(each, name) for each, name in zip((braked, free, unknown), "abc", strict=True)]
    signals, _, _ = panels(standard_figure(runs, ""))
    found = curves(signals[1])
    same(found[0], braked["time"], RISING)
    same(found[1], free["time"], np.zeros(SAMPLES))
    assert [text.get_text() for text in signals[1].texts] == ["no data"]


@pytest.mark.parametrize("size", ["88x130", "180x120", "170x200"])
def test_a_figure_has_the_size_that_was_asked_for_and_texts_that_fit_it(tmp_path, size):
    runs = [drawn(commanded(**FORCES), "with"), drawn(recorded(), "without")]
    figure = standard_figure(runs, "title", named_size(size, "--size"))
    save_figure(figure, tmp_path / "figure.png")
    width, height = map(float, size.split("x"))
    pixels = imread(tmp_path / "figure.png").shape
    assert pixels[:2] == pytest.approx((height / 25.4 * 300, width / 25.4 * 300), abs=1)
    texts = [
        text for axis in figure.axes for text in (axis.title, axis.yaxis.label, axis._left_title)
    ]
    natural = 254.0, 25.4 * (1.0 + 1.35 * 8)  # mm, with eight panels
    font = max(6.0, 10.0 * min(width / natural[0], height / natural[1]))
    for text in texts:
        assert not text.get_text() or text.get_fontsize() == pytest.approx(font)
    with drawn_at(figure.scale):
        boxes = [axis.get_tightbbox() for axis in panels(figure)[0]]
    for upper, lower in itertools.pairwise(boxes):
        assert upper.y0 > lower.y1 - 3  # pixels: one below the other, as their names are
    assert min(box.x0 for box in boxes) >= 0.0


@pytest.mark.parametrize("text", WRONG_SIZES)
def test_what_is_no_size_is_refused_with_what_is_one(text):
    with pytest.raises(InputError, match=r"--size: .*WIDTHxHEIGHT in mm, from 80x120"):
        named_size(text, "--size")
