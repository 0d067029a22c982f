"""Only tire forces and gravity change the momentum of the vehicle."""

import numpy as np
import pytest
from mechanics import GRAVITY, along, couples, external, momenta, slope, spin_axes
from programmes import Evaluation, with_moments
from random_states import attitude, random_command, random_state, wheel_centres

from vehicle_roll_sim import Options

pytestmark = [pytest.mark.slow, pytest.mark.unmeasured]

STATES = 100
"""Random states per variant; in about half of them wheels are off the ground."""
RELATIVE = 1e-13
"""Of the largest single contribution: rounding of a 6 x 6 solution, seen 2e-15."""


def close(rate: np.ndarray, contributions: np.ndarray) -> bool:
    scale = np.abs(contributions).max()
    return bool(np.abs(rate - contributions.sum(axis=0)).max() < RELATIVE * scale)


@pytest.fixture(params=[False, True], ids=["transient slip", "steady-state slip"])
def steady_state_slip(request) -> bool:
    return request.param


LINKS = {
    "roll centre": {},
    "each side's own link load transfer": {"link_load_transfer": "asymmetric"},
    "no roll centre": {"no_roll_centre": True},
}


@pytest.fixture(params=LINKS)
def links(request) -> dict:
    return LINKS[request.param]


@pytest.fixture
def evaluation(vehicle, links, steady_state_slip):
    return Evaluation(
        vehicle, Options(euler_terms=True, steady_state_slip=steady_state_slip, **links)
    )


@pytest.fixture
def on_moments(vehicle, links):
    """A vehicle whose tires have moments, and the model that it is evaluated in."""
    vehicle = with_moments(vehicle)
    return vehicle, Evaluation(vehicle, Options(euler_terms=True, **links))


def random_cases(vehicle, evaluation, seed: int):
    rng = np.random.default_rng(seed)
    for _ in range(STATES):
        state, command = random_state(vehicle, rng), random_command(rng)
        evaluation.torque = command["wheel_torque"]
        yield state, evaluation.rates(state, command), evaluation.outputs


def test_tire_forces_and_weights_are_all_that_changes_the_linear_momentum(vehicle, evaluation):
    for state, rates, outputs in random_cases(vehicle, evaluation, seed=1):
        linear, _ = momenta(vehicle, along(state, rates))
        forces, _ = external(vehicle, state, outputs)
        assert close(slope(linear), forces), state


def test_their_moments_are_all_that_changes_the_angular_momentum(vehicle, evaluation):
    """With the gyroscopic terms on, which the source leaves out."""
    for state, rates, outputs in random_cases(vehicle, evaluation, seed=2):
        _, angular = momenta(vehicle, along(state, rates))
        assert close(slope(angular), np.cross(*external(vehicle, state, outputs)[::-1])), state


@pytest.mark.parametrize("product", [-150.0, 90.0])
def test_so_it_is_with_a_product_of_inertia(unequal_axles, links, product):
    vehicle = unequal_axles.with_values({"roll_yaw_product": product})
    evaluation = Evaluation(vehicle, Options(euler_terms=True, **links))
    for state, rates, outputs in random_cases(vehicle, evaluation, seed=12):
        linear, angular = momenta(vehicle, along(state, rates))
        forces, points = external(vehicle, state, outputs)
        assert close(slope(linear), forces), state
        assert close(slope(angular), np.cross(points, forces)), state


def test_with_contact_moments_they_and_the_forces_are_all_that_changes_the_momentum(on_moments):
    vehicle, evaluation = on_moments
    for state, rates, outputs in random_cases(vehicle, evaluation, seed=8):
        linear, angular = momenta(vehicle, along(state, rates))
        forces, points = external(vehicle, state, outputs)
        moments = np.vstack([np.cross(points, forces), couples(state, outputs)])
        assert close(slope(linear), forces), state
        assert close(slope(angular), moments), state
        assert (couples(state, outputs)[outputs["normal_force"] == 0.0] == 0.0).all()
        assert couples(state, outputs)[outputs["normal_force"] > 0.0].all()


def test_the_contact_moments_about_its_axis_turn_a_wheel(on_moments):
    vehicle, evaluation = on_moments
    for state, rates, outputs in random_cases(vehicle, evaluation, seed=9):
        rise = spin_axes(vehicle, state, outputs)
        np.testing.assert_allclose(np.sin(outputs["inclination"]), rise, rtol=0, atol=1e-12)
        about_axis = outputs["rolling_resistance_moment"] * np.sqrt(1.0 - rise**2)
        about_axis += outputs["aligning_moment"] * rise
        without = vehicle.wheel_inertia * rates["wheel_speed"] - about_axis
        torque = without + outputs["loaded_radius"] * outputs["tire_longitudinal"]
        rounding = RELATIVE * max(1e4, np.abs(about_axis).max())
        np.testing.assert_allclose(torque, evaluation.torque, rtol=0, atol=rounding)


def test_without_the_euler_terms_the_angular_momentum_lacks_just_them(vehicle, steady_state_slip):
    """R (w x J w), and nothing else, is what the source's equations drop."""
    options = Options(no_roll_centre=True, steady_state_slip=steady_state_slip)
    evaluation = Evaluation(vehicle, options)
    inertia = np.array([vehicle.roll_inertia, vehicle.pitch_inertia, vehicle.yaw_inertia])
    for state, rates, outputs in random_cases(vehicle, evaluation, seed=3):
        _, angular = momenta(vehicle, along(state, rates))
        moments = np.cross(*external(vehicle, state, outputs)[::-1])
        turning = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
        rotation = attitude(state["roll"], state["pitch"], state["yaw"])
        dropped = rotation @ np.cross(turning, inertia * turning)
        assert close(slope(angular) - dropped, moments), state


def test_velocities_are_the_rates_of_the_positions(vehicle, evaluation):
    """Equations 1, 9, 10, 12 and 35-37: the wheel centres move as the unsprung masses do."""
    for state, rates, outputs in random_cases(vehicle, evaluation, seed=4):
        rotation = attitude(state["roll"], state["pitch"], state["yaw"])
        moving = slope(wheel_centres(vehicle, along(state, rates)))
        unsprung = (outputs["unsprung_u"], outputs["unsprung_v"], state["unsprung_velocity"])
        expected = np.column_stack(unsprung) @ rotation.T
        np.testing.assert_allclose(moving, expected, rtol=0, atol=1e-12 * np.abs(expected).max())
        sinking = -moving[:, 2]
        np.testing.assert_allclose(rates["tire_compression"], sinking, rtol=0, atol=1e-12 * 100)


def test_accelerations_and_what_an_accelerometer_reads_are_those_of_the_velocity(
    vehicle, evaluation
):
    for state, rates, outputs in random_cases(vehicle, evaluation, seed=7):
        moved = along(state, rates)
        rotation = attitude(moved["roll"], moved["pitch"], moved["yaw"])
        acceleration = slope(rotation @ np.array([moved["u"], moved["v"], moved["w"]]))
        scale = 1e-12 * max(1.0, np.abs(acceleration).max())
        in_yawed = attitude(0.0, 0.0, state["yaw"]).T @ acceleration
        np.testing.assert_allclose(outputs["acceleration"], in_yawed, rtol=0, atol=scale)
        felt = rotation.real.T @ (acceleration - GRAVITY)
        np.testing.assert_allclose(outputs["specific_force"], felt, rtol=0, atol=scale)


def test_each_wheel_spins_up_by_its_torque_less_the_tires(vehicle, evaluation):
    rng = np.random.default_rng(5)
    for _ in range(STATES):
        state, command = random_state(vehicle, rng), random_command(rng)
        rates, outputs = evaluation.rates(state, command), evaluation.outputs
        steering = np.repeat([command["steering"], command["rear_steering"]], 2)
        along_wheel = outputs["longitudinal_force"] * np.cos(steering)
        along_wheel += outputs["lateral_force"] * np.sin(steering)
        torque = command["wheel_torque"] - outputs["loaded_radius"] * along_wheel
        spun = vehicle.wheel_inertia * rates["wheel_speed"]
        np.testing.assert_allclose(spun, torque, rtol=0, atol=RELATIVE * 1e4)  # N m


def test_random_states_lift_some_wheels_and_press_others(vehicle, evaluation):
    lifted = [
        outputs["normal_force"] == 0 for _, _, outputs in random_cases(vehicle, evaluation, 6)
    ]
    assert 0.1 < np.mean(lifted) < 0.9
