"""Figures that are taken from samples say so if these are coarse."""

import numpy as np
import pytest

from vehicle_roll_sim import preset, run
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History

COARSE = {"figures": "from samples 0.5 s apart instead of the usual 0.01 s"}


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("corkscrew_ramp", {"duration": 3.0}),
        ("split_friction_braking", {"duration": 2.0}),
        ("braking_in_a_turn", {"handwheel_angle": 30.0, "duration": 7.0}),
        ("sine_with_dwell", {"steering_at_03g": 20.0, "duration": 4.0}),
    ],
)
def test_coarse_samples_are_named_beside_the_figures_and_usual_ones_are_not(name, values):
    reports = [run(name, preset(), sample=sample, **values).report for sample in (0.5, 0.01)]
    assert reports[0].items() >= COARSE.items()
    assert list(reports[0])[-1] == "figures"
    assert "figures" not in reports[1]


def test_a_run_without_figures_says_nothing_of_samples():
    assert run("step_steer", preset(), sample=0.5).report == {}


def test_the_interval_is_the_longest_one_between_two_samples():
    rows = np.zeros((4, len(COLUMNS)))
    rows[:, 0] = 0.0, 0.1, 0.4, 0.5
    assert History(rows).interval == pytest.approx(0.3, rel=1e-12)
    assert History(rows[:1]).interval == 0.0
