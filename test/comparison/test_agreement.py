"""Errors, shift, correlation and gain of signals made with known ones."""

import math

import numpy as np
import pytest

from vehicle_roll_sim.comparison.agreement import agreement, shifted, time_shift

INTERVAL = 0.01
TIME = np.arange(0.0, 8.0, INTERVAL)


def swing(time: np.ndarray) -> np.ndarray:
    """A pulse with oscillation, 0 at both ends."""
    return np.exp(-((time - 4.0) ** 2)) * np.sin(5.0 * time)


@pytest.mark.parametrize("shift", [-0.2, -0.013, 0.0, 0.0042, 0.31])
def test_a_shift_comes_back_also_between_samples(shift):
    found = time_shift(swing(TIME - shift), swing(TIME), INTERVAL)
    # the parabola of the correlation is exact to the fourth order of the interval
    assert found == pytest.approx(shift, abs=1e-5)


def test_a_gain_comes_back_despite_a_shift_an_offset_and_noise():
    noise = np.random.default_rng(1).normal(0.0, 0.05, len(TIME))
    measured = swing(TIME - 0.05) / 1.2 + 0.3 + noise
    found = agreement(measured, swing(TIME), INTERVAL)
    assert found.gain == pytest.approx(1.2, rel=0.02)  # 3 standard errors of the slope
    assert found.shift == pytest.approx(0.05, abs=2e-3)
    assert found.offset == pytest.approx(-0.3, abs=0.01)


def test_errors_are_those_of_a_constant_offset():
    found = agreement(swing(TIME) - 0.25, swing(TIME), INTERVAL)
    assert found.rms == pytest.approx(0.25, abs=1e-12)
    assert found.peak_error == pytest.approx(0.25, abs=1e-12)
    assert found.peak == pytest.approx(np.abs(swing(TIME) - 0.25).max(), abs=1e-12)


@pytest.mark.parametrize(
    "measured", [np.zeros(len(TIME)), np.random.default_rng(2).normal(size=len(TIME))]
)
def test_signals_that_are_not_alike_have_no_shift_and_no_gain(measured):
    found = agreement(measured, swing(TIME), INTERVAL)
    assert math.isnan(found.shift)
    assert math.isnan(found.gain)


def test_a_shift_at_the_end_of_the_search_is_none():
    assert math.isnan(time_shift(swing(TIME - 0.9), swing(TIME), INTERVAL))


def test_a_moved_signal_is_unknown_where_it_was_not_measured():
    moved = shifted(TIME, 0.1, INTERVAL)
    assert np.isnan(moved[:10]).all()
    np.testing.assert_allclose(moved[10:], TIME[10:] - 0.1, atol=1e-12)
