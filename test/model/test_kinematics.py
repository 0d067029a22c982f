"""Frames, slips and radii: positions of the wheels, their motion over the road, and their slip."""

import magic_formula
import numpy as np
import pytest
from programmes import SOURCE, Evaluation
from random_states import attitude, random_command, random_state
from scipy.spatial.transform import Rotation
from tire_springs import tire_loads

from vehicle_roll_sim import Options
from vehicle_roll_sim.model.frames import (
    body_to_yawed,
    euler_rates,
    heading_of,
    quaternion,
    yawed_to_body,
    yawed_to_ground,
)

CASES = 200
ROUNDING = 1e-12
"""Relative: a dozen operations in double precision, and some cancellation."""
SIDE = np.array([1.0, -1.0, 1.0, -1.0])
"""The reference tire is a left-hand one."""


def random_attitudes(seed: int):
    """Roll, pitch, yaw (rad) short of the singularity, and some vector."""
    rng = np.random.default_rng(seed)
    for roll, pitch, yaw in rng.uniform((-3.1, -1.5, -3.1), (3.1, 1.5, 3.1), (CASES, 3)):
        yield roll, pitch, yaw, rng.normal(size=3)


def sines(roll, pitch):
    return np.sin(roll), np.cos(roll), np.sin(pitch), np.cos(pitch)


def test_rotations_are_those_of_a_library():
    for roll, pitch, yaw, vector in random_attitudes(1):
        tilt = Rotation.from_euler("ZYX", [0.0, pitch, roll])
        turn = Rotation.from_euler("Z", yaw)
        tilted = body_to_yawed(sines(roll, pitch), *vector)
        np.testing.assert_allclose(tilted, tilt.apply(vector), atol=ROUNDING)
        back = yawed_to_body(sines(roll, pitch), *vector)
        np.testing.assert_allclose(back, tilt.inv().apply(vector), atol=ROUNDING)
        flat = yawed_to_ground(heading_of(yaw), vector[0], vector[1])
        np.testing.assert_allclose(flat, turn.apply([*vector[:2], 0.0])[:2], atol=ROUNDING)


def test_the_quaternion_is_that_of_a_library():
    for roll, pitch, yaw, _ in random_attitudes(2):
        expected = Rotation.from_euler("ZYX", [yaw, pitch, roll]).as_quat()
        mine = np.array(quaternion(roll, pitch, yaw))
        mine *= np.sign(mine @ expected)  # q and -q are one rotation
        np.testing.assert_allclose(mine, expected, atol=ROUNDING)


def test_angle_rates_turn_the_body_as_its_rates_say():
    """dR/dt = R [w x], by a complex step along the angles."""
    step = 1e-30
    for roll, pitch, yaw, w in random_attitudes(3):
        rates = np.array(euler_rates(sines(roll, pitch), *w))
        turned = attitude(*(np.array([roll, pitch, yaw]) + 1j * step * rates))
        spin = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
        expected = attitude(roll, pitch, yaw) @ spin
        bound = ROUNDING * max(1.0, np.abs(rates).max())  # rates grow near the singularity
        np.testing.assert_allclose(turned.imag / step, expected, atol=bound)


@pytest.fixture
def cases(vehicle):
    """Random states and commands with their outputs."""

    def generate(options: Options = SOURCE):
        evaluation, rng = Evaluation(vehicle, options), np.random.default_rng(4)
        for _ in range(CASES):
            state, command = random_state(vehicle, rng), random_command(rng)
            state["u"] *= rng.choice([1.0, -1.0])  # backwards as well, as after a spin
            evaluation.rates(state, command)
            yield state, command, evaluation.outputs

    return generate


@pytest.fixture(params=[Options(), SOURCE], ids=["transient slip", "steady-state slip"])
def options(request) -> Options:
    return request.param


def test_loads_and_radii_are_those_of_springs_that_cannot_pull(vehicle, cases, options):
    for state, _, outputs in cases(options):
        pressed = np.maximum(state["tire_compression"], 0.0)
        np.testing.assert_allclose(
            outputs.normal_force, tire_loads(vehicle, pressed), rtol=ROUNDING
        )
        upright = attitude(state["roll"], state["pitch"], 0.0)[2, 2]
        radius = vehicle.tire_radius - pressed / upright  # (15, 16)
        np.testing.assert_allclose(outputs.loaded_radius, radius, rtol=ROUNDING)


def contact_velocities(state, outputs) -> np.ndarray:
    """Of the lowest point of every wheel, along the axes of frame 2 (m/s)."""
    rates = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
    centres = np.column_stack([outputs.unsprung_u, outputs.unsprung_v, state["unsprung_velocity"]])
    down = np.column_stack([np.zeros((4, 2)), -outputs.loaded_radius])
    # the wheel carrier turns with roll and pitch; its yaw does not move the point below it
    return (centres + np.cross(rates, down)) @ attitude(state["roll"], state["pitch"], 0.0).T


def test_steady_state_slips_are_those_of_the_contact_point_in_wheel_axes(cases):
    for state, command, outputs in cases():
        steering = np.repeat([command["steering"], command["rear_steering"]], 2)
        u, v, _ = contact_velocities(state, outputs).T
        rolling = u * np.cos(steering) + v * np.sin(steering)
        sliding = v * np.cos(steering) - u * np.sin(steering)
        kappa = (outputs.loaded_radius * state["wheel_speed"] - rolling) / np.abs(rolling)
        bound = 1e-9 * max(1.0, np.abs(kappa).max())  # slow rolling magnifies rounding
        np.testing.assert_allclose(outputs.slip_ratio, kappa, rtol=0, atol=bound)
        alpha = np.arctan2(sliding, np.abs(rolling))
        np.testing.assert_allclose(outputs.slip_angle, alpha, rtol=0, atol=1e-9)


def test_contact_forces_are_those_of_the_tire_turned_by_the_steering(vehicle, cases, options):
    coefficients = vehicle.tire.coefficients
    for _, command, outputs in cases(options):
        steering = np.repeat([command["steering"], command["rear_steering"]], 2)
        load = np.maximum(outputs.normal_force, 1e-15)  # N: the formula divides by it
        kappa, alpha = outputs.slip_ratio, outputs.slip_angle
        fx, fy = magic_formula.combined(coefficients, kappa, SIDE * alpha, load)
        turned = Rotation.from_euler("Z", steering[:, None]).apply(
            np.column_stack([fx, SIDE * fy, np.zeros(4)])
        )
        bound = 1e-10 * max(1.0, load.max())  # N
        np.testing.assert_allclose(outputs.longitudinal_force, turned[:, 0], rtol=0, atol=bound)
        np.testing.assert_allclose(outputs.lateral_force, turned[:, 1], rtol=0, atol=bound)


@pytest.mark.parametrize("spin", [0.0, 50.0, -50.0])
def test_a_wheel_that_slides_straight_across_gets_finite_forces(vehicle, spin):
    """Its rolling speed, which the steady-state slip ratio divides by, is 0."""
    evaluation, rng = Evaluation(vehicle), np.random.default_rng(5)
    state, command = random_state(vehicle, rng), random_command(rng)
    for name in state.dtype.names[3:]:  # no angle, no rate: only sliding
        state[name] = 0.0
    state["v"], state["wheel_speed"], state["tire_compression"] = 10.0, spin, 0.02
    command["steering"] = command["rear_steering"] = 0.0
    rates = evaluation.rates(state, command)
    assert all(np.isfinite(rates[name]).all() for name in rates.dtype.names)
    np.testing.assert_allclose(evaluation.outputs.slip_angle, np.pi / 2, atol=1e-9)
    friction = 1.5 * evaluation.outputs.normal_force  # more than any coefficient of the tire
    assert (np.abs(evaluation.outputs.lateral_force) < friction).all()
