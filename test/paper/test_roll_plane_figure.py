"""The figure of the roll-plane models: their curves, those of model 1, and its data."""

import csv

import numpy as np
import pytest

from vehicle_roll_sim.paper import figures
from vehicle_roll_sim.paper.report import lift_off_thresholds
from vehicle_roll_sim.vehicle.derived_values import GRAVITY

ROUNDING = 1e-12
"""Relative: a product of two numbers."""


@pytest.fixture
def roll_plane(study, monkeypatch, tmp_path) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """The curves of the figure of the roll-plane models by their label in the legend."""
    kept = {}
    monkeypatch.setattr(figures, "save_figure", lambda drawing, path: kept.update({path: drawing}))
    figures.draw_roll_plane(study, tmp_path)
    (axis,) = kept[tmp_path / "roll_plane.png"].axes
    found = {line.get_label(): line.get_data() for line in axis.get_lines()}
    assert [text.get_text() for text in axis.get_legend().get_texts()] == list(found)
    return found


def test_the_roll_plane_models_transfer_all_load_from_their_threshold_on(roll_plane, study):
    thresholds = iter(lift_off_thresholds(study).values())
    for label in ("rigid roll plane", "suspended roll plane"):
        acceleration, ratio = roll_plane[label]
        assert ratio[0] == 0.0
        above = acceleration >= next(thresholds)
        assert above.any()
        assert np.all(ratio[above] == 1.0)
        assert np.all(ratio[~above] < 1.0)


@pytest.mark.parametrize("case", ["1", "8dof"])
def test_beside_them_stands_the_ramp_steer_up_to_the_first_lift_off(roll_plane, study, case):
    acceleration, ratio = roll_plane[f"model {case}, ramp steer up to lift-off"]
    response = study.ramp(case)
    until = np.flatnonzero((response.loads == 0.0).any(axis=1))[0]
    expected = response.history["lateral_acceleration"][:until] / GRAVITY
    np.testing.assert_allclose(acceleration, expected, rtol=ROUNDING)
    lf, rf, lr, rr = response.loads[:until].T
    np.testing.assert_allclose(ratio, (rf + rr - lf - lr) / (lf + rf + lr + rr), atol=ROUNDING)


def test_the_data_of_the_roll_plane_are_its_curves_in_full_precision(roll_plane, tmp_path):
    found = {}
    with (tmp_path / "roll_plane.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["model", "lateral_acceleration", "load_transfer_ratio"]
    for label, *values in rows:
        found.setdefault(label, []).append([float(value) for value in values])
    assert list(found) == list(roll_plane)
    for label, (acceleration, ratio) in roll_plane.items():
        accelerations, ratios = np.array(found[label]).T
        np.testing.assert_array_equal(accelerations / GRAVITY, acceleration)
        np.testing.assert_array_equal(ratios, ratio)
