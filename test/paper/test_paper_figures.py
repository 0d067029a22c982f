"""The figures of the paper: their curves, the marks of events, and their data."""

import csv
import dataclasses
import importlib.util
import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.lines import Line2D
from studies import Rerun

from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.paper import figures
from vehicle_roll_sim.paper.figures import FIGURES, PaperFigure
from vehicle_roll_sim.paper.study import (
    ENGINE,
    NO_ROLL_CENTRE,
    SAME_AS_ENGINE,
    UPRIGHT_TIRES,
    Study,
)

pytestmark = pytest.mark.unmeasured

J_TURN = ("j_turn", {"1", SAME_AS_ENGINE, ENGINE})
CURVES = {
    6: J_TURN,
    7: J_TURN,
    8: ("step_steer", {"1", "1a", "1b"}),
    9: ("ramp_steer", {"1", "1a", "1b"}),
    10: ("step_steer", {"1b", "1c-i", "1c-ii"}),
    11: ("ramp_steer", {"1b", "1c-i", "1c-ii"}),
    12: ("step_steer", {"1b", "1c-iii", "1c-iv"}),
    13: ("ramp_steer", {"1b", "1c-iii", "1c-iv"}),
    14: ("step_steer", {"1", NO_ROLL_CENTRE, UPRIGHT_TIRES}),
    15: ("ramp_steer", {"1", NO_ROLL_CENTRE, UPRIGHT_TIRES}),
    17: ("step_steer", {"1", "8dof"}),
    18: ("ramp_steer", {"1", "8dof"}),
}
"""Manoeuvre and models of each figure of the source that is no drawing."""
LOADS = {f"{wheel} load\n(kN)": (f"normal_force_{wheel}", 1e-3) for wheel in WHEELS}
SIGNALS = {
    "steering, front\nroad wheels (deg)": ("steering", math.degrees(1)),
    "roll angle\n(deg)": ("roll", math.degrees(1)),
    "lateral acceleration\n(m/s²)": ("lateral_acceleration", 1.0),
    "yaw rate\n(deg/s)": ("yaw_rate", math.degrees(1)),
    **LOADS,
}
"""Label of each panel, column of the history, and factor to the unit of the label."""
DATA = {"time", "steering", "roll", "lateral_acceleration", "yaw_rate"} | {
    name for name, _ in LOADS.values()
}
MILLISECOND = 0.001
"""s between two samples."""
ROUNDING = 1e-12
"""Relative: a product of two numbers."""


@dataclasses.dataclass(frozen=True)
class Drawn:
    """A figure as it was drawn: what it is, the matplotlib object, and its file of data."""

    figure: PaperFigure
    drawing: Figure
    data: Path

    @property
    def panels(self) -> dict[str, Axes]:
        return {axis.get_ylabel(): axis for axis in self.drawing.axes}

    @property
    def legend(self) -> list[str]:
        return [text.get_text() for text in self.drawing.legends[0].get_texts()]

    def rows(self) -> dict[str, list[dict[str, str]]]:
        """Rows of the data of each model."""
        rows = {}
        with self.data.open(newline="") as file:
            for row in csv.DictReader(file):
                rows.setdefault(row.pop("model"), []).append(row)
        return rows


def curves(axis: Axes) -> list[Line2D]:
    return [line for line in axis.get_lines() if line.get_marker() == "None"]


def marks(axis: Axes, marker: str) -> dict[str, tuple[float, float]]:
    """Time and value of each mark of a kind, by its colour, but for those that are nowhere."""
    found = {}
    for line in axis.get_lines():
        (x, *_), (y, *_) = line.get_data()
        if line.get_marker() == marker and not math.isnan(x):
            found[line.get_color()] = float(x), float(y)
    return found


def drawn(figure: PaperFigure, study: Study, folder: Path) -> Drawn:
    """Draws a figure and its data, but does not paint the picture, which takes the longest."""
    kept = []
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(figures, "save_figure", lambda drawing, path: kept.append(drawing))
        figures.draw(figure, study, folder)
    (data,) = folder.glob(f"*_{figure.number:02}.csv")
    return Drawn(figure, kept[0], data)


@pytest.fixture(scope="module", params=FIGURES, ids=lambda figure: figure.name)
def one(request, study, tmp_path_factory) -> Drawn:
    """Each figure of the source, drawn once for all tests."""
    return drawn(request.param, study, tmp_path_factory.mktemp("figures"))


def present(figure: PaperFigure, study: Study) -> list[str]:
    """Cases of a figure, without the multibody engine where it is not installed."""
    return [case for case in figure.cases if case != ENGINE or study.has_engine]


def test_there_are_the_figures_of_the_source_with_its_manoeuvres_and_models():
    found = {figure.number: (figure.manoeuvre, set(figure.cases)) for figure in FIGURES}
    assert found == CURVES
    assert [figure.number for figure in FIGURES] == sorted(CURVES)
    assert all(len(figure.cases) == len(set(figure.cases)) for figure in FIGURES)


def test_each_shows_the_signals_of_the_source_over_time(one):
    expected = LOADS if one.figure.number == 7 else SIGNALS
    assert set(one.panels) == set(expected)
    bottom = [axis.get_xlabel() for axis in one.drawing.axes[-len(one.figure.columns) :]]
    assert bottom == ["time (s)"] * len(one.figure.columns)


def test_each_says_its_number_its_manoeuvre_and_its_models(one, study):
    title = one.drawing.get_suptitle()
    assert title.startswith(f"Figure {one.figure.number}: ")
    assert one.figure.manoeuvre.replace("_", " ") in title.lower().replace("-", " ")
    cases = present(one.figure, study)
    assert len(one.legend) == len(cases)
    for label, case in zip(one.legend, cases, strict=True):
        assert label in (case, f"model {case}")


def test_each_curve_is_every_sample_of_a_run_in_a_line_of_its_own(one, study):
    for label, axis in one.panels.items():
        name, factor = SIGNALS[label]
        looks = set()
        for case, line in zip(present(one.figure, study), curves(axis), strict=True):
            history = study.response(one.figure.manoeuvre, case).history
            times, values = line.get_data()
            np.testing.assert_array_equal(times, history["time"])
            np.testing.assert_allclose(values, history[name] * factor, rtol=ROUNDING)
            looks.add((line.get_color(), line.get_linestyle()))
        assert len(looks) == len(curves(axis))


def test_lift_offs_are_marked_where_and_when_a_wheel_lifts(one, study):
    cases = present(one.figure, study)
    for i, wheel in enumerate(WHEELS):
        axis = one.panels[f"{wheel} load\n(kN)"]
        expected = {}
        for case, line in zip(cases, curves(axis), strict=True):
            lifted = study.response(one.figure.manoeuvre, case).lift_offs[i]
            if not math.isnan(lifted):
                expected[line.get_color()] = (lifted, 0.0)
                times, loads = line.get_data()
                assert loads[times < lifted].min() > 0.0
                assert loads[times >= lifted][0] == 0.0
        assert marks(axis, "o") == expected
    others = set(one.panels) - set(LOADS)
    assert not any(marks(one.panels[label], "o") for label in others)


def test_rollovers_are_marked_where_the_roll_passes_85_degrees(one, study):
    rollovers = {}
    for label, axis in one.panels.items():
        if label != "roll angle\n(deg)":
            assert not marks(axis, "x")
            continue
        for case, line in zip(present(one.figure, study), curves(axis), strict=True):
            rollover = study.response(one.figure.manoeuvre, case).rollover
            if not math.isnan(rollover):
                rollovers[line.get_color()] = rollover
        found = marks(axis, "x")
        assert set(found) == set(rollovers)
        for colour, (time, angle) in found.items():  # at the sample after it
            assert 0.0 <= time - rollovers[colour] <= MILLISECOND
            assert 85.0 <= angle < 86.0
    if one.figure.manoeuvre == "step_steer":
        assert not rollovers


def test_the_data_are_the_samples_of_10_ms_and_the_last_one_in_full_precision(one, study):
    rows = one.rows()
    assert list(rows) == present(one.figure, study)
    for case, found in rows.items():
        history = study.response(one.figure.manoeuvre, case).history
        last = len(history["time"]) - 1
        samples = [*range(0, last, 10), last]
        assert set(found[0]) == DATA
        for name in DATA:
            values = [float(row[name]) for row in found]
            np.testing.assert_array_equal(values, history[name][samples])
        every = np.diff([float(row["time"]) for row in found])
        np.testing.assert_allclose(every[:-1], 0.01, rtol=0.0, atol=1e-9)
        assert 0.0 < every[-1] < 0.01 + 1e-9


@pytest.mark.skipif(not importlib.util.find_spec("mujoco"), reason="no multibody engine")
@pytest.mark.parametrize("number", [6, 7])
def test_without_the_engine_the_other_two_curves_are_drawn(study, monkeypatch, tmp_path, number):
    figure = next(figure for figure in FIGURES if figure.number == number)
    monkeypatch.setattr(importlib.util, "find_spec", lambda *_: None)
    without = Rerun(study)
    assert not without.has_engine
    found = drawn(figure, without, tmp_path)
    assert list(found.rows()) == ["1", SAME_AS_ENGINE]
    assert found.legend == ["model 1", SAME_AS_ENGINE]
    assert {len(curves(axis)) for axis in found.drawing.axes} == {2}
    assert without.asked == {("j_turn", "1"), ("j_turn", SAME_AS_ENGINE)}


def test_drawn_again_a_figure_has_the_same_bytes_and_shows_something(study, monkeypatch, tmp_path):
    figure = next(figure for figure in FIGURES if figure.number == 9)
    contents = []
    for now in ("0", "1000000000"):  # of 1970 and of 2001, for what writes the date
        monkeypatch.setenv("SOURCE_DATE_EPOCH", now)
        folder = tmp_path / now
        folder.mkdir()
        figures.draw(figure, study, folder)
        assert sorted(file.name for file in folder.iterdir()) == ["figure_09.csv", "figure_09.png"]
        contents.append([file.read_bytes() for file in sorted(folder.iterdir())])
    assert contents[0] == contents[1]
    pixels = imread(folder / "figure_09.png")
    assert min(pixels.shape[:2]) > 900
    colours = {tuple(pixel) for pixel in pixels[::3, ::3, :3].reshape(-1, 3).round(1).tolist()}
    assert len(colours) > 20
