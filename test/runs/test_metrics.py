"""Metrics of a run, against signals with known values in closed form."""

import itertools
import math
import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation
from scipy.stats import linregress

from vehicle_roll_sim.runs.metrics import (
    crossing_times,
    lift_off_times,
    load_transfer,
    load_transfer_ratio,
    peak,
    rms,
    roll_gradient,
    rollover_time,
    sideslip_angle,
    steady,
    understeer_gradient,
)

pytestmark = pytest.mark.filterwarnings("error")
NAN, NOTHING = math.nan, np.array([])
SIDES = pytest.mark.parametrize("side", [1.0, -1.0], ids=["left", "right"])
OTHER_SIDE = [1, 0, 3, 2]
"""Wheels in the order lf, rf, lr, rr, exchanged across the vehicle."""
ROUNDING = 1e-12
"""Relative: sums and quotients of some hundred terms, each good to 1e-16."""
FEW_LEVELS = arrays(float, st.integers(0, 30), elements=st.integers(-2, 2).map(float))
"""Signals that often touch 0, follow it or cross it at a sample."""
LOADS = arrays(float, (3, 5, 4), elements=st.sampled_from([0.0, 1.0, 2500.0, 9e3]))
EPOCH = 1_700_000_000
"""s: times of a recording count from 1970."""
UNHURRIED = settings(deadline=None)
"""The machine may be busy."""


@SIDES
def test_the_peak_is_the_value_of_the_largest_magnitude_with_its_sign(side):
    values = side * np.array([1.0, NAN, -3.0, 2.0, 3.0])
    assert peak(np.arange(5.0), values) == (-3.0 * side, 2.0)


@pytest.mark.parametrize("values", [NOTHING, np.full(3, NAN)])
def test_without_samples_there_is_no_peak(values):
    assert np.isnan(peak(np.arange(len(values)), values)).all()


def test_the_last_half_second_of_four_seconds_is_500_samples_of_a_millisecond():
    time = np.arange(4001) / 1000
    number = np.arange(4001.0)
    assert steady(time, number) == np.mean(number[-500:])
    four = np.outer(number, [1, 2, 3, 4])
    np.testing.assert_array_equal(steady(time, four), four[-500:].mean(axis=0))


@UNHURRIED
@given(st.integers(1, 3000), st.integers(1, 400), st.integers(1, 20), st.sampled_from([0, EPOCH]))
def test_a_window_has_as_many_samples_as_fit_however_the_times_are_rounded(
    end, samples, milliseconds, epoch
):
    time = epoch + np.arange(end + 1) * milliseconds / 1000
    number = np.arange(end + 1.0)
    expected = number[-samples:].mean()
    window = samples * milliseconds / 1000
    assert steady(time, number, window) == pytest.approx(expected, rel=ROUNDING)


def test_over_a_whole_number_of_periods_the_effective_value_of_a_sine_is_its_amplitude_by_root_2():
    wave = 5.0 * np.sin(np.arange(1000) * 2 * math.pi * 7 / 1000)
    assert rms(wave) == pytest.approx(5.0 / math.sqrt(2), rel=ROUNDING)
    both = rms(np.column_stack([wave, -2 * wave]))
    np.testing.assert_allclose(both, [5 / math.sqrt(2), 10 / math.sqrt(2)], rtol=ROUNDING)


def test_the_mean_of_nothing_or_of_a_gap_is_not_a_number():
    assert math.isnan(steady(NOTHING, NOTHING))
    assert math.isnan(rms(NOTHING))
    assert np.isnan(steady(NOTHING, np.empty((0, 4)))).tolist() == [True] * 4
    assert math.isnan(steady(np.arange(3.0), np.array([1.0, 1.0, NAN]), 2.0))


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([-1.0, 3.0, 2.0, -2.0], [0.25, 2.5]),
        ([-1.0, 0.0, 1.0], [1.0]),
        ([1.0, 0.0, 0.0, 0.0, -1.0], [1.0]),
        ([1.0, 0.0, 1.0], []),
        ([1.0, 0.0, 0.0, 1.0], []),
        ([0.0, 0.0, 1.0, 0.0], []),
        ([-1.0, NAN, 1.0], [1.0]),
        ([NAN], []),
        ([], []),
    ],
)
def test_a_level_is_crossed_only_by_going_from_one_side_of_it_to_the_other(values, expected):
    values = np.array(values)
    time = np.arange(float(len(values)))
    for level, side in itertools.product([0.0, 8.0], [1.0, -1.0]):
        assert crossing_times(time, side * values + level, level).tolist() == expected


@UNHURRIED
@given(FEW_LEVELS)
def test_there_are_as_many_crossings_as_changes_of_side_each_on_the_level(values):
    time = np.cumsum(np.arange(len(values)) % 3 + 1.0)
    crossings = crossing_times(time, values)
    sides = [side for side, _ in itertools.groupby(values[values != 0.0] > 0.0)]
    assert len(crossings) == max(len(sides) - 1, 0)
    assert np.all(np.diff(crossings) > 0)
    if len(crossings):  # 1e-14: of values up to 2 at times up to 60
        np.testing.assert_allclose(np.interp(crossings, time, values), 0.0, atol=1e-14)


@SIDES
def test_load_transfer_is_the_moment_of_the_lateral_force_over_the_track(side):
    mass, height, track, acceleration, share = 2000.0, 0.7, 1.6, side * 3.0, np.array([0.6, 0.4])
    moved = share * mass * acceleration * height / track
    axle = share * mass * 9.81 / 2
    loads = np.ravel(np.column_stack([axle - moved, axle + moved]))
    np.testing.assert_allclose(load_transfer(loads), moved, rtol=ROUNDING)
    ratio = load_transfer_ratio(loads)
    assert isinstance(ratio, float)
    expected = 2 * acceleration * height / (9.81 * track)
    assert ratio == pytest.approx(expected, rel=ROUNDING)


@UNHURRIED
@given(LOADS)
def test_load_transfer_is_mirrored_bounded_and_the_same_for_one_set_as_for_many(loads):
    moved, ratio = load_transfer(loads), load_transfer_ratio(loads)
    assert (moved.shape, ratio.shape) == ((3, 5, 2), (3, 5))
    np.testing.assert_array_equal(load_transfer(loads[..., OTHER_SIDE]), -moved)
    np.testing.assert_array_equal(load_transfer_ratio(loads[..., OTHER_SIDE]), -ratio)
    assert np.abs(ratio).max() <= 1.0
    assert [[load_transfer_ratio(four) for four in row] for row in loads] == ratio.tolist()


def test_the_ratio_is_1_on_the_right_wheels_alone_0_on_none_and_unknown_of_the_unknown():
    loads = np.array([[0.0, 5.0, 0.0, 1.0], [0.0, 0.0, 0.0, 0.0], [NAN, 1.0, 1.0, 1.0]])
    np.testing.assert_array_equal(load_transfer_ratio(loads), [1.0, 0.0, NAN])
    assert load_transfer_ratio(np.zeros(4)) == 0.0


def test_sideslip_is_the_angle_of_the_way_over_the_ground_whatever_the_attitude_of_the_body():
    """Velocities on the ground, as an independent library turns them into the body's axes."""
    ahead, left = np.array([20.0, 20.0, 5.0, -3.0]), np.array([1.0, -2.0, 5.0, 0.3])
    roll, pitch = np.array([0.0, 0.2, -1.2, 0.1]), np.array([0.0, -0.1, 0.3, 0.05])
    attitudes = Rotation.from_euler("YX", np.column_stack((pitch, roll)))
    velocity = attitudes.inv().apply(np.column_stack((ahead, left, [0.0, 1.0, -2.0, 0.0])))
    found = sideslip_angle(velocity.T, roll, pitch)
    np.testing.assert_allclose(found, np.arctan(left / ahead), rtol=ROUNDING)


def test_sideslip_of_an_infinite_roll_angle_is_unknown_without_a_warning():
    ones = np.ones(1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for angle in (np.inf, -np.inf):
            assert np.isnan(sideslip_angle((ones, ones, ones), angle * ones, 0 * ones))


def test_sideslip_without_heave_and_pitch_or_in_standstill():
    u, v, w = np.array([10.0, 0.01, 5.0]), np.array([1.0, 0.0, -5.0]), np.full(3, NAN)
    found = sideslip_angle((u, v, w), np.zeros(3), np.full(3, NAN))
    np.testing.assert_allclose(found, [np.arctan(0.1), NAN, -np.pi / 4], rtol=ROUNDING)


def test_a_wheel_lifts_at_the_first_sample_without_load_after_one_with_load():
    again, never, late, after_a_gap = [1, 0, 1, 0], [9, 9, 9, 9], [0, 0, 2, 0], [1, NAN, 0, 0]
    loads = np.array([again, never, late, after_a_gap], float).T
    time = np.array([0.0, 0.1, 0.2, 0.3])
    expected = np.array([0.1, NAN, 0.3, 0.2])
    np.testing.assert_array_equal(lift_off_times(time, loads), expected)
    mirrored = lift_off_times(time, loads[:, OTHER_SIDE])
    np.testing.assert_array_equal(mirrored, expected[OTHER_SIDE])


@pytest.mark.parametrize("loads", [np.empty((0, 4)), np.zeros((3, 4)), np.full((3, 4), NAN)])
def test_wheels_that_never_carried_load_do_not_lift(loads):
    assert np.isnan(lift_off_times(np.arange(len(loads)), loads)).tolist() == [True] * 4


@SIDES
@pytest.mark.parametrize(
    ("roll", "expected"),
    [
        ([0.0, 0.5, 1.5, 0.0, 9.0], 1.5),
        ([0.0, 1.0, 0.0], 1.0),
        ([2.0, 3.0], 0.0),
        ([-0.5, 1.5], 0.75),
        ([0.0, NAN, 2.0], 1.0),
        ([0.0, 0.9, -0.9, NAN], NAN),
        ([], NAN),
    ],
)
def test_the_vehicle_rolls_over_when_the_line_between_samples_first_reaches_the_angle(
    side, roll, expected
):
    time = rollover_time(np.arange(float(len(roll))), side * np.array(roll), 1.0)
    assert time == pytest.approx(expected, rel=ROUNDING, nan_ok=True)


@SIDES
def test_the_roll_gradient_is_that_of_a_body_on_roll_springs_whatever_the_roll_at_rest(side):
    mass, arm, stiffness = 1700.0, 0.6, 1e5
    acceleration = side * np.linspace(0.0, 4.0, 50)
    hanging = mass * arm / (stiffness - mass * arm * 9.81)  # moment of weight and inertia
    roll = hanging * acceleration + 0.01
    assert roll_gradient(acceleration, roll) == pytest.approx(hanging, rel=ROUNDING)


def test_the_roll_gradient_of_scattered_samples_is_that_of_least_squares():
    acceleration, roll = np.random.default_rng(1).normal(size=(2, 200))
    expected = linregress(acceleration, roll).slope
    assert roll_gradient(acceleration, roll) == pytest.approx(expected, rel=ROUNDING)


@SIDES
@pytest.mark.parametrize("rear_stiffness", [70e3, 110e3], ids=["oversteer", "understeer"])
def test_the_understeer_gradient_is_that_of_the_linear_bicycle_at_any_speed(side, rear_stiffness):
    mass, front, rear, front_stiffness = 1500.0, 1.2, 1.5, 80e3
    steering, speed = side * np.linspace(0.005, 0.02, 16), np.linspace(8.0, 16.0, 16)
    force = front_stiffness + rear_stiffness
    moment = front * front_stiffness - rear * rear_stiffness
    of_yaw = front**2 * front_stiffness + rear**2 * rear_stiffness
    yaw_rate = np.empty(16)
    for i, u in enumerate(speed):  # steady turn: lateral velocity and yaw rate
        forces_and_moments = [[force, moment + mass * u**2], [moment, of_yaw]]
        steered = np.array([1.0, front]) * front_stiffness * u * steering[i]
        yaw_rate[i] = np.linalg.solve(forces_and_moments, steered)[1]
    wheelbase = front + rear
    gradient = understeer_gradient(speed * yaw_rate, steering, yaw_rate, speed, wheelbase)
    expected = mass / wheelbase * (rear / front_stiffness - front / rear_stiffness)
    assert gradient == pytest.approx(expected, rel=1e-9)  # difference of two 30 times as large


def test_the_understeer_gradient_may_be_read_at_one_speed():
    yaw_rate = np.linspace(-0.2, 0.3, 20)
    steering = 2.7 * yaw_rate / 20.0 + 0.004 * 20.0 * yaw_rate
    gradient = understeer_gradient(20.0 * yaw_rate, steering, yaw_rate, 20.0, 2.7)
    assert gradient == pytest.approx(0.004, rel=ROUNDING)


@pytest.mark.parametrize(
    "acceleration", [NOTHING, np.ones(1), np.full(7, 0.1), 1e-9 * np.arange(5.0)]
)
def test_without_a_turn_there_is_no_gradient(acceleration):
    assert math.isnan(roll_gradient(acceleration, acceleration))
    assert math.isnan(understeer_gradient(*[acceleration] * 3, 10.0, 2.7))


def test_signals_of_another_length_than_the_time_are_refused():
    time, values, loads = np.arange(4.0), np.zeros(3), np.zeros((3, 4))
    for metric in (peak, steady, crossing_times):
        with pytest.raises(IndexError):
            metric(time, values)
    with pytest.raises(ValueError, match="broadcast"):
        lift_off_times(time, loads)
    with pytest.raises(ValueError, match="mismatch"):
        roll_gradient(time, values)
