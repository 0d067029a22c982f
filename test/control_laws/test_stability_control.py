"""Stability control: its reference, its choice of wheels, its thresholds, and what it prevents."""

import dataclasses

import numpy as np
import pytest
from driven import REFERENCE, begun, driven, filled_in, mirrored

from vehicle_roll_sim import InputError
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.control_laws.stability_control import StabilityControl
from vehicle_roll_sim.model.records import YAW_RATE

LF, RF, LR, RR = range(4)
STRAIGHT = {
    "time": 0.0,
    "steering": 0.0,
    "rear_steering": 0.0,
    "u": 20.0,
    "v": 0.0,
    "yaw_rate": 0.0,
    "roll": 0.0,
    "roll_rate": 0.0,
}
ROLLING = {"roll": 0.1, "roll_rate": 0.5}
"""Extrapolated by 0.15 s: 0.175 rad, above the threshold of 0.14 rad."""
SETTINGS = StabilityControl()


@pytest.fixture
def control():
    return begun(StabilityControl())


def torques(control, **motion) -> np.ndarray:
    return np.array(control.answer_to(STRAIGHT | motion)["brake_torque"])


@pytest.mark.parametrize("steering", [0.01, -0.015])
def test_the_reference_is_the_yaw_rate_of_the_steady_turn(control, steering):
    """2 %: at 2 to 3 m/s^2 tires are no longer quite linear."""
    trim = find_trim(REFERENCE, speed=20.0, steering=steering)
    assert control.wanted(20.0, steering) == pytest.approx(trim.state[YAW_RATE], rel=0.02)


def test_the_reference_demands_no_more_lateral_acceleration_than_the_grip(control):
    assert 20.0 * control.wanted(20.0, 0.3) == pytest.approx(SETTINGS.grip * 9.81)
    assert 20.0 * control.wanted(20.0, -0.3) == pytest.approx(-SETTINGS.grip * 9.81)


def test_the_reference_follows_the_steering_behind_its_lag():
    """Its step response is 1 - (lag / (lag + T))^n after n periods T."""
    control = begun(StabilityControl(yaw_off=0.0, yaw_on=0.0))
    torques(control)
    for n in range(1, 20):
        torque = torques(control, time=0.01 * n, steering=0.01)[LR]
        reached = control.wanted(20.0, 0.01) * (1.0 - (0.1 / 0.11) ** n)
        assert torque == pytest.approx(SETTINGS.yaw_gain * reached)


@pytest.mark.parametrize(
    ("motion", "wheel"),
    [
        ({"yaw_rate": 0.2}, RF),  # too much to the left: outer front wheel
        ({"yaw_rate": -0.2}, LF),
        ({"steering": 0.05}, LR),  # too little to the left: inner rear wheel
        ({"steering": -0.05}, RR),
        ({"steering": 0.05, "yaw_rate": -0.2}, LF),  # spins to the other side
    ],
)
def test_it_brakes_the_wheel_that_turns_the_vehicle_towards_the_reference(control, motion, wheel):
    assert np.flatnonzero(torques(control, **motion)).tolist() == [wheel]


@pytest.mark.parametrize(("side", "outer", "inner"), [(1.0, RF, LF), (-1.0, LF, RF)])
def test_against_roll_it_brakes_in_front_and_outside_most(control, side, outer, inner):
    rolling = {name: side * value for name, value in ROLLING.items()}
    found = torques(control, **rolling)
    assert found[outer] == SETTINGS.roll_torque
    assert found[inner] == 0.5 * SETTINGS.roll_torque
    assert not found[[LR, RR]].any()


def test_it_begins_at_the_upper_threshold_and_ends_at_the_lower_one(control):
    on, off = SETTINGS.yaw_on, SETTINGS.yaw_off
    rates = [0.0, off, 0.5 * (on + off), 0.999 * on, on, 0.5 * (on + off), 1.01 * off, off, on]
    braking = [
        bool(torques(control, time=0.01 * k, yaw_rate=rate).any()) for k, rate in enumerate(rates)
    ]
    assert braking == [False, False, False, False, True, True, True, False, True]


def test_a_roll_intervention_lasts_until_the_lower_threshold(control):
    rolls = [0.13, 0.14, 0.1, 0.091, 0.089, 0.13]
    braking = [torques(control, time=0.01 * k, roll=roll)[RF] > 0.0 for k, roll in enumerate(rolls)]
    assert braking == [False, True, True, True, False, False]


def test_after_a_reset_nothing_of_an_intervention_is_left(control):
    between = {"yaw_rate": 0.5 * (SETTINGS.yaw_on + SETTINGS.yaw_off)}
    assert torques(control, yaw_rate=0.2).any()
    assert torques(control, time=0.01, **between).any()
    assert not torques(control, **between).any()


def test_no_torque_exceeds_the_largest(control):
    assert torques(control, yaw_rate=3.0, **ROLLING).max() == SETTINGS.largest_torque


def test_it_does_nothing_at_a_standstill(control):
    assert not torques(control, u=0.5, yaw_rate=1.0, **ROLLING).any()


def test_a_mirrored_motion_is_answered_in_the_mirror():
    rng = np.random.default_rng(0)
    here, there = (begun(StabilityControl()) for _ in range(2))
    for k in range(200):
        spread = {"steering": 0.1, "yaw_rate": 0.5, "roll": 0.1, "roll_rate": 0.5}
        motion = STRAIGHT | {name: rng.normal() * size for name, size in spread.items()}
        motion["time"] = 0.01 * k
        found = torques(here, **motion)
        assert torques(there, **mirrored(motion)).tolist() == found[[RF, LF, RR, LR]].tolist()


def test_a_gentle_turn_is_left_alone(control):
    history = driven(filled_in("step_steer", amplitude=1.0), control)
    assert not history.command("brake_torque").any()


def test_the_sine_with_dwell_that_rolls_the_passive_vehicle_over_is_passed(control):
    """FMVSS 126 at 80 km/h: the yaw rate dies down, and the vehicle has moved aside."""
    manoeuvre = filled_in("sine_with_dwell")
    without, found = driven(manoeuvre), driven(manoeuvre, control)
    assert without["time"][-1] < manoeuvre.duration  # rolled over
    assert not manoeuvre.result(without).is_passed
    assert found["time"][-1] == manoeuvre.duration
    assert manoeuvre.result(found).is_passed
    assert np.degrees(np.abs(found["roll"]).max()) < 12.0
    assert np.abs(np.arctan2(found["v"], found["u"])).max() < np.radians(8.0)


@pytest.mark.parametrize(
    ("values", "problem"),
    [
        ({"yaw_off": 0.07}, "yaw_off: 0.07 is not allowed: at most yaw_on, 0.06"),
        ({"roll_on": 0.05}, "roll_off: 0.09 is not allowed: at most roll_on, 0.05"),
        ({"yaw_gain": -1.0}, "yaw_gain"),
        ({"grip": float("nan")}, "grip"),
    ],
)
def test_wrong_settings_are_refused(values, problem):
    with pytest.raises(InputError, match=problem):
        dataclasses.replace(SETTINGS, **values)
