"""Driving along a side slope against the roll plane and the balance of forces."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import Condition, InputError, Options, RollPlane, preset, run
from vehicle_roll_sim.runs.metrics import load_transfer_ratio

GRAVITY = 9.81


@pytest.fixture(scope="module")
def driven():
    return {side: run("side_slope", side=side) for side in ("left", "right")}


def test_the_tires_hold_what_gravity_pulls_downhill(driven):
    result = driven["left"]
    forces = [
        result.history.wheels(f"{name}_force")[-1].sum() for name in ("longitudinal", "lateral")
    ]
    yaw = result["yaw"][-1]
    uphill = forces[1] * math.cos(yaw) + forces[0] * math.sin(yaw)
    wanted = preset().mass * GRAVITY * math.sin(math.radians(15.0))
    assert uphill == pytest.approx(wanted, rel=2e-3)  # it still rocks a little
    load = result.history.wheels("normal_force")[-1].sum()
    assert load == pytest.approx(wanted / math.tan(math.radians(15.0)), rel=2e-3)


def ratio_on(vehicle, slope: float) -> float:
    """Load transfer ratio of the suspended vehicle on a slope (rad).

    (K - m g hrc cos a) phi = m g hrc sin a, with the stiffness K of springs and tires in series
    about the roll axis. The contact points are on axes of the body, which the slope and the roll
    turn against gravity: (Fr - Fl) / (Fr + Fl) = h tan(a + phi) / T, with the half track T and the
    height h of the c.g. of the whole vehicle.
    """
    plane = RollPlane(vehicle.record(), suspended=False)
    gradient = RollPlane(vehicle.record()).roll_gradient  # m hrc / (K - m g hrc)
    length = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    front, rear = vehicle.front_roll_centre_depth, vehicle.rear_roll_centre_depth
    depth = (front * vehicle.cg_to_rear_axle + rear * vehicle.cg_to_front_axle) / length
    tipping = vehicle.sprung_mass * depth * GRAVITY
    stiffness = tipping / GRAVITY / gradient + tipping
    roll = tipping * math.sin(slope) / (stiffness - tipping * math.cos(slope))
    return plane.cg_height * math.tan(slope + roll) / (plane.track / 2)


@pytest.mark.parametrize("slope", [5.0, 15.0])
def test_its_load_transfer_is_that_of_the_roll_plane(slope):
    """First order in the roll of up to 0.05, whose square is 0.002; the body also rises by 3 mm."""
    result = run("side_slope", slope=slope, duration=6.0)
    found = np.mean(load_transfer_ratio(result.history.wheels("normal_force"))[-50:])
    assert found == pytest.approx(ratio_on(preset(), math.radians(slope)), rel=0.01)
    assert result.report["steady load transfer ratio"] == f"{found:.4f}"


def test_the_driver_holds_the_course_by_steering_uphill_and_without_one_it_drifts(driven):
    """The axles carry the side forces of a turn of g sin(15 deg), whose understeer gradient is
    0.0412 deg/(m/s^2) (docs/manoeuvres.md); in a turn loads are higher and drag is more."""
    left, right = driven["left"], driven["right"]
    assert abs(left["y"]).max() < 0.15
    steering = math.degrees(left["steering"][-1])
    assert steering == pytest.approx(0.0412 * GRAVITY * math.sin(math.radians(15.0)), rel=0.25)
    np.testing.assert_allclose(left["y"], -right["y"], rtol=0, atol=1e-6)
    loose = run("side_slope", steered_by="fixed")
    assert not loose["steering"].any()
    assert loose["y"][-1] < -2.0
    assert loose.report["drift"] == f"{loose['y'][-1]:.3f} m"


def test_all_models_drive_along_a_plane_and_what_is_not_allowed_is_said():
    flat = run("side_slope", options=Options("8dof"), slope=10.0, duration=2.0)
    assert flat["x"][-1] > 15.0
    steep = run("side_slope", slope=44.0, duration=5.0)
    assert steep.condition is not Condition.RUNNING
    assert steep.report == {"steady driving": "none: the run ended early"}
    with pytest.raises(InputError, match=r"^steered_by: 'nobody' .*driver, fixed"):
        run("side_slope", steered_by="nobody")


def test_a_run_that_is_shorter_than_the_mean_has_no_steady_driving():
    assert run("side_slope", duration=0.4).report == {
        "steady driving": "unknown: the run is too short"
    }
