"""Left-right symmetry: mirrored input gives mirrored output."""

import numpy as np
import pytest
from programmes import SHIFTS, SOURCE, j_turn, ramp_and_hold, record_run, with_moments, with_tire

from vehicle_roll_sim import LF, Options, Simulation
from vehicle_roll_sim.model.records import SLIP_STATES, STATE

pytestmark = [pytest.mark.slow, pytest.mark.unmeasured]

TORQUE = np.array([0.0, 100.0, 300.0, -50.0])
"""N m; like the next, different at every wheel, so that a wheel taken for another shows."""
BRAKE = np.array([20.0, 0.0, 60.0, 40.0])
"""N m"""
FORCE = np.array([100.0, 0.0, 500.0, -200.0])
"""N"""
OTHER_SIDE = [1, 0, 3, 2]
"""Wheels in the order lf, rf, lr, rr, exchanged across the vehicle."""
REVERSED_STATES = {"y", "roll", "yaw", "v", "roll_rate", "yaw_rate", "lateral_slip"}
SIGNALS = ("normal_force", "slip_ratio", "tire_longitudinal", "loaded_radius")
REVERSED_SIGNALS = ("slip_angle", "lateral_force", "tire_lateral", "link_y")
MOMENTS = {
    "overturning_moment": True,
    "rolling_resistance_moment": False,
    "aligning_moment": True,
    "inclination": True,
}
"""What only tires with moments have, and whether it is reversed."""
SHARE_OF_PEAK = 1e-9
"""Only the order of sums differs: 1e-15, grown by the fall to the side to 2e-13."""


def mirrored(values: np.ndarray, reverse: bool) -> np.ndarray:
    swapped = values[:, OTHER_SIDE] if values.ndim == 2 else values
    return -swapped if reverse else swapped


def share_of_peak(values: np.ndarray, other: np.ndarray, reverse: bool) -> float:
    return np.abs(values - mirrored(other, reverse)).max() / np.abs(values).max()


@pytest.fixture(
    params=[
        pytest.param((None, {}), id="symmetric tire"),
        pytest.param(("left", SHIFTS), id="left-hand tire"),
        pytest.param(("right", SHIFTS), id="right-hand tire"),
        pytest.param(("left", MOMENTS), id="left-hand tires with moments"),
    ]
)
def tired(request, vehicle):
    side, coefficients = request.param
    if coefficients is MOMENTS:
        return with_moments(vehicle)
    return with_tire(vehicle, side, **coefficients)


@pytest.fixture(
    params=[
        pytest.param(Options(), id="roll centre"),
        pytest.param(Options(no_roll_centre=True), id="no roll centre"),
        pytest.param(SOURCE, id="steady-state slip"),
    ]
)
def options(request) -> Options:
    return request.param


@pytest.fixture
def runs(options, tired):
    """The J-turn to the left and its mirror image to the right, through lift-off."""
    turns = (
        j_turn(wheel_torque=TORQUE, brake_torque=BRAKE, normal_force=FORCE, rear_steering=0.01),
        ramp_and_hold(
            *(1.0, -40.0, 10.0),
            wheel_torque=TORQUE[OTHER_SIDE],
            brake_torque=BRAKE[OTHER_SIDE],
            normal_force=FORCE[OTHER_SIDE],
            rear_steering=-0.01,
        ),
    )
    return [record_run(Simulation(tired, options), turn, 3.0) for turn in turns]


def without(options: Options, name: str) -> bool:
    """Whether the model has no such state: it is nan all along."""
    return name in SLIP_STATES and name not in options.states


def test_mirrored_commands_give_mirrored_motion_and_tire_forces(runs, options, tired):
    left, right = runs
    assert left.outputs["normal_force"][:, LF].min() == 0.0, "no wheel lifts: choose another turn"
    assert len(left.time) == len(right.time)
    shares = {
        name: share_of_peak(left.state[name], right.state[name], name in REVERSED_STATES)
        for name in STATE.names
        if not without(options, name)
    }
    for name in (*SIGNALS, *REVERSED_SIGNALS):
        reverse = name in REVERSED_SIGNALS
        shares[name] = share_of_peak(left.outputs[name], right.outputs[name], reverse)
    if tired.tire_moments:
        for name, reverse in MOMENTS.items():
            shares[name] = share_of_peak(left.outputs[name], right.outputs[name], reverse)
    assert all(share < SHARE_OF_PEAK for share in shares.values()), shares


def test_straight_ahead_stays_straight_whatever_side_the_tire_is_made_for(tired):
    run = record_run(Simulation(tired), ramp_and_hold(0.0, 0.0, 0.0), 1.0)
    for name in REVERSED_STATES:
        assert np.abs(run.state[name]).max() < SHARE_OF_PEAK, name  # left and right cancel


def test_the_side_of_a_tire_with_shifts_matters(reference):
    """Otherwise the mirrored tires above would prove nothing."""
    rolls = []
    for side in ("left", "right"):
        run = record_run(Simulation(with_tire(reference, side, **SHIFTS)), j_turn(), 1.5)
        rolls.append(np.degrees(run.state["roll"].max()))
    assert abs(rolls[0] - rolls[1]) > 0.1  # degrees
