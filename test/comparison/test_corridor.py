"""Corridors: the outline of rectangles, by brute force and in closed form."""

import numpy as np
import pytest

from vehicle_roll_sim.comparison.corridor import (
    Tolerances,
    over_acceleration,
    over_time,
    share_inside,
)
from vehicle_roll_sim.input_errors import InputError

TIME = np.linspace(0.0, 4.0, 401)
SIMULATED = np.sin(2.0 * TIME)


def test_over_time_it_is_the_outline_of_all_rectangles():
    tolerances = Tolerances(time_tolerance=0.05, gain_tolerance=10.0, offset_tolerance=2.0)
    lower, upper = over_time(SIMULATED, 1.5, 0.01, tolerances)
    half = 0.1 * np.abs(SIMULATED) + 0.02 * 1.5
    for i, time in enumerate(TIME):
        near = np.abs(TIME - time) <= 0.05 + 1e-9
        assert upper[i] == pytest.approx((SIMULATED + half)[near].max(), abs=1e-15)
        assert lower[i] == pytest.approx((SIMULATED - half)[near].min(), abs=1e-15)


@pytest.mark.parametrize(("shift", "is_inside"), [(0.049, True), (0.08, False)])
def test_a_late_signal_is_inside_up_to_the_tolerance_of_time(shift, is_inside):
    tolerances = Tolerances(time_tolerance=0.05, gain_tolerance=0.0, offset_tolerance=0.1)
    boundaries = over_time(SIMULATED, 1.0, 0.01, tolerances)
    share = share_inside(np.sin(2.0 * (TIME - shift)), *boundaries)
    assert (share > 0.98) == is_inside  # at the beginning the simulation has no earlier samples


@pytest.mark.parametrize(("gain", "is_inside"), [(1.049, True), (1.2, False)])
def test_a_steep_cross_plot_is_inside_up_to_the_tolerance_of_the_value(gain, is_inside):
    acceleration = np.linspace(0.0, 4.0, 401)
    half = 0.05 * acceleration
    boundaries = over_acceleration(acceleration, acceleration, acceleration, (1e-9, half))
    assert (share_inside(gain * acceleration, *boundaries) == 1.0) == is_inside


def test_beyond_the_simulated_accelerations_nothing_is_inside():
    at = np.array([1.0, 9.0])
    ends = over_acceleration(at, np.array([0.9, 1.0]), np.array([2.0, 3.0]), (0.2, np.zeros(2)))
    np.testing.assert_array_equal(ends, [[2.0, np.nan], [3.0, np.nan]])
    assert share_inside(np.array([2.5, 2.5]), *ends) == 0.5


def test_the_share_that_must_be_inside_is_part_of_the_tolerances():
    assert Tolerances(inside=90.0).accepts(0.9)
    assert not Tolerances(inside=95.0).accepts(0.94)
    with pytest.raises(InputError, match="inside: 0 is not allowed"):
        Tolerances(inside=0)
