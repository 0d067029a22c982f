"""Braking on split friction against the stopping distance by hand."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import InputError, preset, run
from vehicle_roll_sim.vehicle.tire_evaluation import evaluate

GRAVITY = 9.81
SPEED, TORQUES, LOW = 20.0, (600.0, 300.0), 0.1


def braking_force(load: float, torque: float, vehicle, deceleration: float) -> float:
    """Of both wheels of an axle (N): one at the torque less what slows its spin, one locked."""
    radius = vehicle.tire_radius - load / 2e5
    spin = vehicle.wheel_inertia * deceleration / radius
    tire = vehicle.axle_tires["front"]
    tire = tire.with_coefficients(LMUX=LOW * tire.coefficients["LMUX"])
    locked = evaluate(tire, load, -1.0, 0.0)
    return (torque - spin) / radius + abs(float(np.ravel(locked.longitudinal_force)[0]))


def stopping_distance(vehicle) -> float:
    """v^2 / (2 a) with m a the sum of the forces, and the load m a h / L that moves forward."""
    masses = vehicle.per_wheel("unsprung_mass")
    mass = vehicle.sprung_mass + masses.sum()
    wheelbase = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    moment = vehicle.sprung_mass * vehicle.cg_height + masses.sum() * (vehicle.tire_radius - 0.02)
    front = vehicle.sprung_mass * vehicle.cg_to_rear_axle / wheelbase + masses[:2].sum()
    deceleration = 0.0
    for _ in range(50):
        moved = moment * deceleration / wheelbase
        loads = (front * GRAVITY + moved) / 2, ((mass - front) * GRAVITY - moved) / 2
        forces = [
            braking_force(load, torque, vehicle, deceleration)
            for load, torque in zip(loads, TORQUES, strict=True)
        ]
        deceleration = sum(forces) / mass
    return SPEED**2 / (2.0 * deceleration)


@pytest.fixture(scope="module")
def results():
    return {side: run("split_friction_braking", side=side) for side in ("left", "right")}


def test_it_stops_within_the_distance_of_constant_forces(results):
    """The driver's side force against the yaw moment, 830 N at some 3 deg, brakes by 1 % more."""
    result = results["right"]
    found = result.manoeuvre.distance(result.history)
    assert found == pytest.approx(stopping_distance(preset()), rel=0.02)
    assert result.report["stopping distance"] == f"{found:.3f} m"
    assert abs(result["y"]).max() < 0.5


def test_the_other_side_is_its_mirror_image(results):
    left, right = results["left"], results["right"]
    np.testing.assert_allclose(left["x"], right["x"], rtol=0, atol=1e-6)
    np.testing.assert_allclose(left["y"], -right["y"], rtol=0, atol=1e-6)


def test_a_vehicle_that_slides_sideways_has_not_stopped():
    result = run("split_friction_braking", front_brake_torque=1500.0, rear_brake_torque=750.0)
    assert abs(result["yaw"]).max() > math.radians(60.0)
    sliding = (result["u"] < 0.1) & (abs(result["v"]) > 1.0)
    first = int(np.argmax(sliding))
    assert sliding[first]
    stopped = result.manoeuvre.distance(result.history)
    assert math.isnan(stopped) or stopped > result["x"][first] - SPEED


def test_a_vehicle_without_brakes_does_not_stop():
    result = run(
        "split_friction_braking", front_brake_torque=0.0, rear_brake_torque=0.0, duration=2.0
    )
    assert result.report["stopping distance"] == "does not stop"
    with pytest.raises(InputError, match="low_friction"):
        run("split_friction_braking", low_friction=-0.1)
