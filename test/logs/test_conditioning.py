"""Gaps, clocks, filter and the place of sensors against closed forms."""

import numpy as np
import pytest
from scipy.signal import butter, sosfreqz

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs import conditioning

TIME = np.arange(0.0, 4.0, 0.01)


def test_a_repeated_time_is_left_out_and_a_clock_that_steps_back_is_refused():
    kept = conditioning.checked_times(np.insert(TIME, 5, TIME[5]), "time")
    assert kept.sum() == len(TIME)
    jumped = np.concatenate((TIME, TIME[-1] - 2.0 + TIME))
    with pytest.raises(InputError, match=r"time: the clock steps back by 2 s after 3.99 s: times"):
        conditioning.checked_times(jumped, "time")
    with pytest.raises(InputError, match="time: none in row 4: a time in every row"):
        conditioning.checked_times(np.where(np.arange(len(TIME)) == 3, np.nan, TIME), "time")
    with pytest.raises(InputError, match="5 rows: at least 20 rows"):
        conditioning.checked_times(TIME[:5], "time")


def test_a_short_gap_is_filled_by_a_straight_line_and_told():
    values = 3.0 * TIME + 1.0
    values[100:110] = np.nan
    (time, found), note = conditioning.filled((TIME, values), "roll")
    np.testing.assert_allclose(found, 3.0 * TIME + 1.0, atol=1e-12)
    assert note == "1 gap of 0.11 s filled"
    assert time is TIME
    assert conditioning.filled((TIME, TIME), "roll")[1] == ""


@pytest.mark.parametrize(
    ("missing", "problem"),
    [
        (slice(100, 130), "roll: a gap of 0.31 s after 0.99 s: gaps of at most 0.25 s"),
        (slice(0, 1), "roll: none in the first: values from the first to the last row"),
        (slice(-1, None), "roll: none in the last: values from the first"),
        (slice(10, None), "roll: 10 values: at least 20 values"),
    ],
)
def test_what_is_missing_for_longer_is_refused(missing, problem):
    values = TIME.copy()
    values[missing] = np.nan
    with pytest.raises(InputError, match=problem):
        conditioning.filled((TIME, values), "roll")


def test_missing_rows_are_a_gap_too():
    rows = np.r_[0:100, 200:400]
    with pytest.raises(InputError, match=r"a gap of 1\.01 s after 0\.99 s"):
        conditioning.filled((TIME[rows], TIME[rows]), "roll")


def test_resampling_never_looks_ahead():
    random = np.random.default_rng(4)
    time = np.cumsum(random.uniform(0.005, 0.015, 300))
    grid = np.arange(time[0], time[-1], 0.01)
    found = conditioning.held((time, time), grid)
    assert (found <= grid + 1e-6).all()
    assert (grid - found < 0.015).all()
    assert set(found) <= set(time)


@pytest.mark.parametrize("frequency", [1.0, 5.0, 10.0, 20.0])
def test_the_filter_has_no_phase_and_twice_the_attenuation_of_a_butterworth_filter(frequency):
    time = np.arange(0.0, 40.0, 0.01)
    wave = np.sin(2 * np.pi * frequency * time)
    found = conditioning.low_pass(wave, 10.0, 0.01)[1000:3000]
    _, response = sosfreqz(butter(2, 10.0, fs=100.0, output="sos"), [frequency], fs=100.0)
    expected = abs(response[0]) ** 2 * wave[1000:3000]
    np.testing.assert_allclose(found, expected, atol=1e-6)
    np.testing.assert_array_equal(conditioning.low_pass(wave, 0.0, 0.01), wave)


def rotation(time: float) -> np.ndarray:
    """From body to ground of a body that rolls, pitches and yaws at once."""
    roll, pitch, yaw = 0.3 * np.sin(2 * time), 0.1 * np.cos(3 * time), 0.5 * time + 0.2 * time**2
    cx, sx, cy, sy, cz, sz = (f(a) for a in (roll, pitch, yaw) for f in (np.cos, np.sin))
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def test_an_acceleration_is_moved_to_the_cg_as_a_rigid_body_moves():
    """The position of a sensor on a turning body, differentiated twice, by differences."""
    place, step = np.array([1.2, -0.4, 0.7]), 1e-3
    time = np.arange(0.0, 2.0, step)
    turned = np.array([rotation(t) for t in time])
    slope = np.gradient(turned, step, axis=0)
    spin = np.einsum("nji,njk->nik", turned, slope)  # skew matrix of the body rates
    rates = spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]
    position = turned @ place
    acceleration = np.gradient(np.gradient(position, step, axis=0), step, axis=0)
    in_body = np.einsum("nji,nj->ni", turned, acceleration)
    at_cg = conditioning.lateral_acceleration_at_cg(in_body[:, 1], rates, tuple(place), step)
    assert np.abs(in_body[:, 1]).max() > 1.0
    np.testing.assert_allclose(at_cg[5:-5], 0.0, atol=1e-4)  # the c.g. is at rest; step^2


def test_a_sideslip_angle_is_moved_to_the_cg_as_a_rigid_body_moves():
    speed, beta, p, r = 20.0, 0.05, 0.3, 0.6
    x, y, z = place = (1.2, -0.4, 0.7)
    velocity = np.cross([p, 0.0, r], place) + np.array([speed, speed * np.tan(beta), 0.0])
    at_sensor = np.arctan2(velocity[1], velocity[0])
    signals = (np.full(5, each) for each in (at_sensor, speed, p, r))
    np.testing.assert_allclose(conditioning.sideslip_at_cg(*signals, (x, y, z)), beta, atol=1e-12)
