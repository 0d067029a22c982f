"""Frequency and damping of a run, against oscillations with known values."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vehicle_roll_sim.runs.metrics import damped_frequency, damping_ratio

pytestmark = pytest.mark.filterwarnings("error")
ROUNDING = 1e-12
"""Relative: sums and quotients of some hundred terms, each good to 1e-16."""
STEP = 1.0
"""s: when the oscillations below begin, from rest."""


def step_response(time, frequency, damping, final):
    """Roll and roll rate of an oscillator of damped frequency (Hz) that is pushed at STEP."""
    swing, decay = decay_of(frequency, damping)
    t = np.maximum(time - STEP, 0.0)
    waned = final * np.exp(-decay * t)
    roll = final - waned * (np.cos(swing * t) + decay / swing * np.sin(swing * t))
    return roll, waned * (swing + decay**2 / swing) * np.sin(swing * t)


def decay_of(frequency, damping):
    """Damped angular frequency and rate of decay (1/s)."""
    swing = 2 * math.pi * frequency
    return swing, swing * damping / math.sqrt(1 - damping**2)


OSCILLATIONS = {
    "frequency": st.floats(0.5, 5.0),
    "damping": st.floats(0.02, 0.5),
    "samples_a_period": st.floats(40.0, 400.0),
    "final": st.sampled_from([0.07, -0.07]),
}


@settings(deadline=None)  # the machine may be busy
@given(**OSCILLATIONS)
def test_frequency_and_damping_of_an_exact_oscillation_are_read_within_the_error_of_interpolation(
    frequency, damping, samples_a_period, final
):
    sample = 1 / (frequency * samples_a_period)
    time = np.arange(0.0, STEP + 2.2 / frequency, sample)
    roll, rate = step_response(time, frequency, damping, final)
    swing, decay = decay_of(frequency, damping)

    # A line through a zero crossing is off by dt²/8 x'' / x' = dt²/8 2 decay; half more for the
    # change of x'' within the interval.
    allowed = 1.5 * frequency**2 * decay * sample**2 / 4
    assert damped_frequency(time, rate, STEP) == pytest.approx(frequency, abs=allowed)

    # A vertex is off by dt³/16 x''' + dt⁴/128 x'''', where x''' = 2 decay w² x and x'''' < w⁴ x;
    # the ratio of two by twice that, the damping ratio by less than a third of it.
    undamped = math.hypot(swing, decay)
    of_vertex = decay * undamped**2 * sample**3 / 8 + (undamped * sample) ** 4 / 128
    allowed = 2 / math.pi * of_vertex + 1e-9  # rounding of extrema down to 1e-4 of roll
    assert damping_ratio(time, roll, STEP, final) == pytest.approx(damping, abs=allowed)


@pytest.mark.parametrize("since", [0.0, STEP, STEP + 0.3, STEP + 0.6, STEP + 1.1])
def test_an_oscillation_has_the_same_frequency_and_damping_from_wherever_it_is_read(since):
    time = np.arange(0.0, 5.0, 1e-3)
    roll, rate = step_response(time, 1.0, 0.2, 0.07)
    # Tolerances: of the exact oscillation at 1 ms, as above.
    assert damped_frequency(time, rate, since) == pytest.approx(1.0, abs=5e-7)
    assert damping_ratio(time, roll, since, 0.07) == pytest.approx(0.2, abs=1e-8)


def test_what_came_before_does_not_matter():
    time = np.arange(0.0, 5.0, 1e-3)
    roll, rate = step_response(time, 1.0, 0.2, 0.07)
    shaken = np.where(time < STEP, np.sin(2 * math.pi * 5 * time), 0.0)
    assert damped_frequency(time, rate + shaken, STEP) == damped_frequency(time, rate, STEP)
    readings = [damping_ratio(time, each, STEP, 0.07) for each in (roll, roll + shaken)]
    assert readings[0] == readings[1]


def test_an_extremum_of_few_samples_is_the_vertex_of_the_parabola_through_three():
    beyond = np.array([-1.0, 0.5, 2.0, -1.0, -0.5, 1.0])
    decrement = math.log((2 + 0.75**2 / 9) / (1 + 1.25**2 / 7))
    expected = decrement / math.hypot(math.pi, decrement)
    ratio = damping_ratio(np.arange(6.0), beyond + 3.0, 0.0, 3.0)
    assert ratio == pytest.approx(expected, rel=ROUNDING)


def test_ripple_is_not_taken_for_the_oscillation():
    time = np.arange(0.0, 5.0, 1e-3)
    roll, _ = step_response(time, 1.0, 0.1, 0.07)
    ripple = 1e-4 * np.sin(2 * math.pi * 31 * time)
    # Each extremum of 0.05 and 0.04 rad is off by up to 1e-4, thus their ratio by 4.5e-3.
    assert damping_ratio(time, roll + ripple, STEP, 0.07) == pytest.approx(0.1, abs=4.5e-3 / 3)


def test_an_oscillation_that_grows_has_negative_damping():
    time = np.arange(0.0, 4.0, 1e-3)
    growing = np.exp(0.5 * time) * np.sin(2 * math.pi * time)
    expected = -0.5 / math.hypot(0.5, 2 * math.pi)
    assert damping_ratio(time, growing, 0.3, 0.0) == pytest.approx(expected, abs=1e-8)


@pytest.mark.parametrize(
    ("until", "frequency_known", "damping_known"),
    [(1.4, False, False), (1.9, False, False), (2.1, False, True), (2.6, True, True)],
)
def test_what_has_not_swung_far_enough_has_no_frequency_or_damping(
    until, frequency_known, damping_known
):
    """Extrema at 1.5, 2.0 and 2.5 s."""
    time = np.arange(0.0, until, 1e-3)
    roll, rate = step_response(time, 1.0, 0.2, 0.07)
    assert math.isfinite(damped_frequency(time, rate, STEP)) == frequency_known
    assert math.isfinite(damping_ratio(time, roll, STEP, 0.07)) == damping_known


@pytest.mark.parametrize(
    "roll", [np.array([]), np.zeros(9), np.full(9, math.nan), -np.exp(-np.arange(9.0))]
)
def test_what_does_not_oscillate_has_no_frequency_or_damping(roll):
    time = np.arange(float(len(roll)))
    assert math.isnan(damped_frequency(time, roll, 0.0))
    assert math.isnan(damping_ratio(time, roll, 0.0, 0.0))
