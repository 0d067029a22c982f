"""The prediction model against steady turns, the simulation, and friction."""

import numpy as np
import pytest
from driven import REFERENCE, driven, filled_in, mirrored, motion_at

from vehicle_roll_sim import Options
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.control_laws.prediction import Inputs, PredictionModel
from vehicle_roll_sim.model.records import STATE_NAMES
from vehicle_roll_sim.runs.metrics import load_transfer_ratio
from vehicle_roll_sim.vehicle.tire_evaluation import evaluate

DT = 0.03
AHEAD = 20
"""Steps: 0.6 s."""


@pytest.fixture(scope="module")
def model():
    return PredictionModel(REFERENCE, DT)


def inputs(angle=0.0, left=0.0, right=0.0) -> list[Inputs]:
    """The same inputs in every step; each a number, or an array of those side by side."""
    return [Inputs(*map(np.atleast_1d, np.broadcast_arrays(angle, left, right)))] * AHEAD


@pytest.fixture(scope="module")
def turning():
    """A motion in a steady turn with 2 m/s^2, and its load transfer ratio."""
    trim = find_trim(REFERENCE, Options(), speed=15.0, lateral_acceleration=2.0)
    names = ("u", "v", "yaw_rate", "roll", "roll_rate")
    motion = {name: float(trim.state[STATE_NAMES.index(name)]) for name in names}
    motion |= {"time": 0.0, "steering": float(trim.inputs[0]), "rear_steering": 0.0}
    return motion, load_transfer_ratio(trim.outputs.normal_force)


def test_a_steady_turn_stays_as_it_is(model, turning):
    """0.001 at once; 0.03 after 0.6 s, as axles without load transfer understeer differently."""
    motion, ratio = turning
    found = model.ratios(motion, inputs())[:, 0]
    assert found[0] == pytest.approx(ratio, abs=0.001)
    assert found == pytest.approx(np.full(AHEAD, ratio), abs=0.03)


def test_it_predicts_the_load_transfer_of_the_simulation(model):
    """0.3 s ahead, in a J-turn with 6 deg, as long as the steering stays as it is.

    0.07: it knows neither how a tire builds up its force nor how load transfer weakens an axle.
    """
    history = driven(filled_in("j_turn", amplitude=6.0, duration=2.5))
    ratios = load_transfer_ratio(history.wheels("normal_force"))
    rows = range(120, len(ratios) - 30)
    assert max(ratios[row + 30] - ratios[row] for row in rows) > 0.4  # it would be easy otherwise
    for row in rows:
        predicted = model.ratios(motion_at(history, row), inputs())[10, 0]
        assert predicted == pytest.approx(ratios[row + 30], abs=0.07), row


def test_predictions_side_by_side_are_those_one_by_one_to_the_bit(model, turning):
    angles, left, right = np.random.default_rng(0).uniform(0.0, [[0.05], [4e3], [4e3]], (3, 7))
    together = model.ratios(turning[0], inputs(angles, left, right))
    for k in range(7):
        alone = model.ratios(turning[0], inputs(angles[k], left[k], right[k]))
        assert alone[:, 0].tolist() == together[:, k].tolist()


def test_the_mirrored_motion_has_the_opposite_ratios(model, turning):
    here = model.ratios(turning[0], inputs(0.02, 500.0, 2000.0))
    there = model.ratios(mirrored(turning[0]), inputs(-0.02, 2000.0, 500.0))
    assert np.allclose(here, -there, rtol=0.0, atol=1e-12)  # rounding


def test_the_grip_is_the_largest_lateral_force_of_the_tire(model):
    angles = np.linspace(-0.6, 0.6, 1201)
    load = 9.81 * (1440.0 * 0.3 + 80.0)  # 60 % of the sprung mass in front, and a wheel
    forces = [
        np.abs(evaluate(REFERENCE.tire, load, 0.0, angles, side=side).lateral_force).max()
        for side in ("left", "right")
    ]
    assert model.front_grip == pytest.approx(np.mean(forces), rel=0.01)  # of the tabulated angles


def test_braking_outside_lowers_the_ratio_and_braking_inside_raises_it(model, turning):
    """They yaw the vehicle out of the turn, and into it."""
    none, outside, inside = model.ratios(turning[0], inputs(0.0, [0, 0, 2000], [0, 2000, 0]))[-1]
    assert outside < none < inside


def test_a_wheel_brakes_no_harder_than_its_load_allows(model, turning):
    hard, harder = model.ratios(turning[0], inputs(0.0, 0.0, [1e5, 1e6]))[-1]
    assert hard == harder


def test_rear_steering_with_the_front_lowers_the_ratio_in_the_end(model, turning):
    """Steered by 0.01 rad the vehicle yaws less; at 15 m/s that is 0.01 of 0.034 rad."""
    none, steered = model.ratios(turning[0], inputs([0.0, 0.01]))[-1]
    assert steered < none
