"""The manoeuvres of the paper's figures, with the results of two other implementations."""

import math

import numpy as np
import pytest
from programmes import SOURCE, j_turn, ramp_and_hold, record_run

from vehicle_roll_sim import WHEELS, Condition, Simulation

SPEED = 50 / 3.6
MILLISECOND = 1.001e-3
"""s: the numbers are given to the millisecond; a thousandth for the binary form of decimals."""
ANGLE = 1e-3
"""Degrees, likewise given to 0.001."""
HOLD = {"speed_hold_gain": 2000.0, "speed_hold_target": SPEED}
HALF_A_SECOND = 500
"""Steps."""


@pytest.fixture(scope="module")
def step_steer(reference):
    """4 degrees in 0.1 s at constant speed: run, and the simulation at its end."""
    simulation = Simulation(reference, SOURCE)
    return record_run(simulation, ramp_and_hold(1.0, 40.0, 4.0, **HOLD), 4.0), simulation


@pytest.fixture(scope="module")
def ramp_steer(reference):
    simulation = Simulation(reference, SOURCE)
    simulation.step(ramp_and_hold(1.0, 4.0, 12.0), 9.0)
    return simulation


@pytest.fixture(scope="module")
def turned_j(reference):
    simulation = Simulation(reference, SOURCE)
    simulation.step(j_turn(), 6.0)
    return simulation


def test_step_steer_peaks_at_5_619_degrees_after_1_664_s(step_steer):
    run, simulation = step_steer
    roll = np.degrees(run.state["roll"])
    assert roll.max() == pytest.approx(5.619, abs=ANGLE)
    assert run.time[roll.argmax()] == pytest.approx(1.664, abs=MILLISECOND)
    value, time = simulation.events.peak_roll
    assert np.degrees(value) == pytest.approx(5.619, abs=ANGLE)
    assert time == pytest.approx(1.664, abs=MILLISECOND)


def test_step_steer_settles_at_5_008_degrees_with_all_wheels_on_the_road(step_steer):
    run, simulation = step_steer
    assert run.time[-1] == pytest.approx(4.0)
    steady = np.degrees(run.state["roll"][-HALF_A_SECOND:]).mean()
    assert steady == pytest.approx(5.008, abs=ANGLE)
    assert run.outputs["normal_force"].min() > 0.0
    assert np.isnan(simulation.events.lift_off_time).all()


def test_step_steer_keeps_its_speed(step_steer):
    """2000 N m per m/s at each rear wheel: 0.1 m/s balances a drag of 1400 N."""
    run, _ = step_steer
    assert np.abs(run.state["u"] - SPEED).max() < 0.1


LIFT_OFF = {
    "ramp": {"lf": 3.732, "rf": 5.078, "lr": 3.020, "rr": 5.207},
    "j": {"lf": 1.572, "rf": 3.001, "lr": 1.395, "rr": 3.119},
}
"""s"""


@pytest.mark.parametrize("wheel", WHEELS)
def test_ramp_steer_lifts_each_wheel_when_the_other_implementations_do(ramp_steer, wheel):
    lifted = ramp_steer.events.lift_off_time[WHEELS.index(wheel)]
    assert lifted == pytest.approx(LIFT_OFF["ramp"][wheel], abs=MILLISECOND)


@pytest.mark.parametrize("wheel", WHEELS)
def test_j_turn_lifts_each_wheel_when_the_other_implementations_do(turned_j, wheel):
    lifted = turned_j.events.lift_off_time[WHEELS.index(wheel)]
    assert lifted == pytest.approx(LIFT_OFF["j"][wheel], abs=MILLISECOND)


def test_ramp_steer_rolls_over_at_5_217_s_and_stops_there(ramp_steer):
    assert ramp_steer.events.rollover_time[0] == pytest.approx(5.217, abs=MILLISECOND)
    stopped_where_it_should(ramp_steer)


def test_j_turn_rolls_over_at_3_130_s_and_stops_there(turned_j):
    assert turned_j.events.rollover_time[0] == pytest.approx(3.130, abs=MILLISECOND)
    stopped_where_it_should(turned_j)


def stopped_where_it_should(simulation):
    assert simulation.condition is Condition.ROLLED_OVER
    assert simulation.state.roll >= math.radians(85.0)
    since = simulation.time - simulation.events.rollover_time[0]
    assert 0.0 <= since <= MILLISECOND  # the step in which it happened is the last
