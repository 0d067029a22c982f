"""The manoeuvres of the paper: steering, sample by sample, and conditions."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import InputError, Options, preset
from vehicle_roll_sim.manoeuvres.catalogue import PAPER, RampAndHold, manoeuvre_named

TIMES = np.linspace(0.0, 12.0, 4801)
"""s: 400 samples a second, the corners of the standard manoeuvres among them."""
ROUNDING = 1e-14
"""rad: a few units in the last place of a road-wheel angle."""
# name: first moving (s), turned by (s), to (deg), duration (s), speed hold (N m s/m)
CONDITIONS = {
    "step_steer": (1.0, 1.1, 4.0, 4.0, 2000.0),
    "ramp_steer": (1.0, 4.0, 12.0, 9.0, 0.0),
    "j_turn": (1.0, 1.25, 10.0, 6.0, 0.0),
}
"""The reference conditions of Shim and Ghike (2007)."""


def line_and_hold(time: float, begin: float, end: float, degrees: float) -> float:
    """Road-wheel angle (rad): 0 until `begin`, then a straight line to `degrees` at `end`."""
    if time <= begin:
        return 0.0
    if time >= end:
        return math.radians(degrees)
    return math.radians(degrees) * (time - begin) / (end - begin)


def expected_steering(*line: float) -> list[float]:
    return [line_and_hold(time, *line) for time in TIMES.tolist()]


def assert_steers_only(commands: np.ndarray) -> None:
    """Of the four commands that a driver gives, only the front steering is not 0."""
    assert np.any(commands["steering"])
    for name in ("rear_steering", "wheel_torque", "normal_force"):
        assert not np.any(commands[name])


@pytest.mark.parametrize("name", CONDITIONS)
def test_a_standard_manoeuvre_has_the_conditions_of_the_source(name):
    begin, end, degrees, duration, speed_hold = CONDITIONS[name]
    manoeuvre = manoeuvre_named(name).for_vehicle(preset(), Options())
    commands = manoeuvre(TIMES)
    expected = expected_steering(begin, end, degrees)
    np.testing.assert_allclose(commands["steering"], expected, rtol=0, atol=ROUNDING)
    assert_steers_only(commands)
    assert manoeuvre.duration == duration
    assert manoeuvre.speed == 50.0 / 3.6
    assert set(commands["speed_hold_gain"]) == {speed_hold}
    assert set(commands["speed_hold_target"]) == {50.0 / 3.6}


def test_there_are_these_manoeuvres_of_the_source_and_no_others():
    assert set(PAPER) == set(CONDITIONS)


@pytest.mark.parametrize("amplitude", [7.0, -7.0, 60.0, -60.0])
@pytest.mark.parametrize(("start", "rate"), [(0.0, 5.0), (2.5, 30.0), (1.0, 1e5)])
def test_the_steering_turns_at_its_rate_to_its_amplitude_and_stays(amplitude, start, rate):
    manoeuvre = RampAndHold(amplitude=amplitude, rate=rate, start=start, duration=12.0)
    commands = manoeuvre(TIMES)
    expected = expected_steering(start, start + abs(amplitude) / rate, amplitude)
    np.testing.assert_allclose(commands["steering"], expected, rtol=0, atol=ROUNDING)
    assert_steers_only(commands)


def test_a_turn_to_the_right_is_a_turn_to_the_left_with_the_other_sign():
    left, right = (
        RampAndHold(amplitude=amplitude, rate=13.0, duration=5.0)(TIMES)["steering"]
        for amplitude in (5.0, -5.0)
    )
    np.testing.assert_array_equal(left, -right)


def test_without_amplitude_it_goes_straight_ahead():
    straight = RampAndHold(amplitude=0.0, rate=40.0, duration=5.0)
    assert not np.any(straight(TIMES)["steering"])


def test_before_its_start_a_manoeuvre_steers_not_at_all():
    late = RampAndHold(amplitude=3.0, rate=40.0, start=100.0, duration=200.0)
    assert not np.any(late(TIMES)["steering"])


def test_commands_at_a_time_do_not_depend_on_the_times_asked_with_it():
    manoeuvre = manoeuvre_named("j_turn")
    together = manoeuvre(TIMES)
    for i in range(0, len(TIMES), 97):
        assert manoeuvre(TIMES[i : i + 1])[0] == together[i]


def test_the_speed_that_is_held_is_the_speed_at_entry():
    manoeuvre = RampAndHold(amplitude=1.0, rate=1.0, duration=1.0, speed=22.0, speed_hold=300.0)
    command = manoeuvre(np.zeros(1))[0]
    assert (command.speed_hold_gain, command.speed_hold_target) == (300.0, 22.0)


@pytest.mark.parametrize("name", ["j_trun", "", "J_TURN", "lane_change"])
def test_an_unknown_manoeuvre_is_refused_with_the_ones_there_are(name):
    with pytest.raises(InputError) as refusal:
        manoeuvre_named(name)
    for known in CONDITIONS:
        assert known in str(refusal.value)
