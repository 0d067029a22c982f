"""Predictive rollover prevention: its solver, its optimum, and wheels that stay down."""

import math

import numpy as np
import pytest
from driven import begun, driven, filled_in, mirrored, motion_at
from scipy.optimize import lsq_linear, minimize

from vehicle_roll_sim import InputError
from vehicle_roll_sim.control_laws.rollover_mpc import RolloverMpc, smallest_within
from vehicle_roll_sim.manoeuvres.criteria import two_wheel_lift
from vehicle_roll_sim.runs.metrics import load_transfer_ratio


@pytest.fixture(scope="module")
def fishhook():
    """At 35 mph, which lifts two wheels of the passive vehicle at 2.09 s."""
    return filled_in("nhtsa_fishhook", duration=4.0)


@pytest.fixture(scope="module")
def without(fishhook):
    return driven(fishhook)


@pytest.fixture(scope="module")
def found(fishhook):
    return driven(fishhook, RolloverMpc())


@pytest.fixture
def law():
    return begun(RolloverMpc())


def test_wheels_stay_down_in_the_fishhook_that_lifts_the_passive_vehicle(fishhook, without, found):
    assert two_wheel_lift(without) < 2.1
    assert without["time"][-1] < fishhook.duration  # rolled over
    assert found["time"][-1] == fishhook.duration
    assert math.isnan(two_wheel_lift(found))
    ratios = load_transfer_ratio(found.wheels("normal_force"))
    assert (
        np.abs(ratios).max() < 0.9
    )  # never near the 1 at which the wheels of a side carry nothing


def test_it_still_turns_as_it_is_steered(fishhook, without, found):
    """At least half as fast as the passive vehicle, then to the other side, and not by stopping."""
    assert found["yaw_rate"].max() > 0.5 * without["yaw_rate"].max()
    assert found["yaw_rate"].min() < -0.5 * found["yaw_rate"].max()
    assert found["u"][-1] > 0.6 * fishhook.speed


def test_inputs_stay_within_their_bounds(found, law):
    largest = law.largest_rear_steering
    assert np.abs(found.commands[:, 0]).max() <= largest
    torque = law.largest_brake_use * law.model.front_grip * law.model.front_radius
    brakes = found.command("brake_torque")
    assert brakes.min() >= 0.0
    assert brakes.max() <= torque * (1.0 + 1e-12)  # rounding
    assert not brakes[:, 2:].any()


def test_a_turn_without_danger_is_left_alone(law):
    history = driven(filled_in("step_steer", amplitude=1.0, duration=2.0), law)
    assert not history.command("brake_torque").any()
    assert not history.commands[:, 0].any()


@pytest.fixture(scope="module")
def danger(without):
    """The motion 0.3 s before both inner wheels are unloaded."""
    ratios = load_transfer_ratio(without.wheels("normal_force"))
    return motion_at(without, np.flatnonzero(np.abs(ratios) > 0.999)[0] - 30)


def test_asked_again_it_finds_the_optimum(law, danger):
    """One Gauss-Newton step per period is not the optimum, but a step towards it.

    1 %: where a change brings a step of the prediction to its limit, the slope has a kink.
    """
    for k in range(20):
        law.answer_to({**danger, "time": 0.01 * k})
    plan, before = law._planned, law._planned

    def cost(x):
        return (law.residuals(danger, x[np.newaxis], before)[0] ** 2).sum()

    bounds = list(zip(law._lower, law._upper, strict=True))
    best = minimize(cost, plan, method="L-BFGS-B", bounds=bounds, options={"maxfun": 3000})
    assert cost(plan) <= 1.01 * best.fun
    assert cost(plan) < 0.2 * cost(np.zeros_like(plan))


def test_the_mirrored_motion_is_answered_in_the_mirror(danger):
    here, there = (begun(RolloverMpc()).answer_to(each) for each in (danger, mirrored(danger)))
    assert there["rear_steering"] == pytest.approx(-here["rear_steering"])
    left, right, _, _ = here["brake_torque"]
    assert there["brake_torque"] == pytest.approx((right, left, 0.0, 0.0))
    assert right > left  # brakes the outer wheel of a turn to the left


def test_after_a_reset_the_same_motion_has_the_same_answer_to_the_bit(law, danger):
    first = law.answer_to(danger)
    assert law.answer_to({**danger, "time": danger["time"] + 0.01}) != first
    assert law.answer_to(danger) == first


def test_it_does_nothing_when_almost_at_a_standstill(law, danger):
    answer = law.answer_to({**danger, "u": 2.0})
    assert answer == {"rear_steering": 0.0, "brake_torque": (0.0,) * 4}


@pytest.mark.parametrize("seed", range(5))
def test_the_bounded_quadratic_problem_is_solved_as_by_scipy(seed):
    """1e-6 of the bounds: what 20 sweeps leave, with a condition number below 100."""
    rng = np.random.default_rng(seed)
    slopes = np.vstack((np.eye(9), 0.5 * rng.normal(size=(20, 9))))
    residual = rng.normal(size=29)
    lower, upper = -rng.uniform(0.0, 0.5, 9), rng.uniform(0.0, 0.5, 9)
    found = smallest_within(slopes, residual, lower, upper)
    expected = lsq_linear(slopes, -residual, (lower, upper), method="bvls", tol=1e-12).x
    assert found == pytest.approx(expected, abs=1e-6)
    assert ((found == lower) | (found == upper)).any()  # or else the bounds do nothing


@pytest.mark.parametrize("name", ["horizon", "interval", "ratio_limit", "largest_brake_use"])
def test_a_setting_out_of_range_is_refused(name):
    with pytest.raises(InputError, match=name):
        RolloverMpc(**{name: -1.0})
