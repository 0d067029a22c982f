"""Without commands a vehicle keeps rolling in equilibrium, carrying its own weight."""

import dataclasses

import numpy as np
import pytest
from programmes import OWN_RADIUS, Evaluation

from vehicle_roll_sim import LF, LR, RF, RR, Command, Condition, Options, Simulation
from vehicle_roll_sim.model.records import STATE

SPEED = 50 / 3.6
MINUTE = 60.0
GRAVITY = 9.81
STEADY = [name for name in STATE.names if name not in ("x", "wheel_angle")]
DRIFT = 1e-9
"""m, rad, m/s, rad/s: a hundred times the rounding of 60,000 steps, far below anything physical."""
ROUNDING = 1e-9
"""Relative: for sums of a few thousand newtons in double precision, with room for the drift."""


@pytest.fixture(params=[False, True], ids=["transient slip", "steady-state slip"])
def steady_state_slip(request) -> bool:
    return request.param


def total_weight(vehicle) -> float:
    unsprung = 2 * (vehicle.front_unsprung_mass + vehicle.rear_unsprung_mass)
    return (vehicle.sprung_mass + unsprung) * GRAVITY


def rolling_on_own_radius(vehicle):
    """The vehicle on front tires whose file gives their rolling radius."""
    own = vehicle.tire.with_coefficients(**OWN_RADIUS)
    return dataclasses.replace(vehicle, tire=None, front_tire=own, rear_tire=vehicle.tire)


@pytest.fixture
def after_a_minute(vehicle, steady_state_slip):
    simulation = Simulation(vehicle, Options(steady_state_slip=steady_state_slip))
    simulation.start = simulation.state.copy()
    simulation.step(Command(), MINUTE)
    return simulation


def test_no_state_drifts_in_a_minute_without_a_command(after_a_minute):
    now, start = after_a_minute.state, after_a_minute.start
    mine = [name for name in STEADY if name in after_a_minute.options.states]
    drift = {name: float(np.abs(now[name] - start[name]).max()) for name in mine}
    assert all(value < DRIFT for value in drift.values()), drift
    assert after_a_minute.condition is Condition.RUNNING


def test_a_free_rolling_vehicle_keeps_its_pace_and_its_wheels_roll_without_slip(after_a_minute):
    state, outputs = after_a_minute.state, after_a_minute.outputs
    assert state.x == pytest.approx(SPEED * MINUTE, rel=ROUNDING)
    assert (outputs.rolling_radius == outputs.loaded_radius).all()
    rolled = state.wheel_angle * outputs.rolling_radius
    np.testing.assert_allclose(rolled, SPEED * MINUTE, rtol=ROUNDING)
    assert np.abs(outputs.slip_ratio).max() < DRIFT


def test_a_tire_that_rolls_on_a_radius_of_its_own_starts_without_slip(vehicle):
    simulation = Simulation(rolling_on_own_radius(vehicle))
    simulation.step(Command(), 1.0)
    outputs, state = simulation.outputs, simulation.state
    free = [0.3, 0.3, *vehicle.per_wheel("tire_radius")[2:]]
    assert (outputs.loaded_radius != outputs.rolling_radius)[:2].all()
    assert (outputs.rolling_radius < free).all()
    np.testing.assert_allclose(state.wheel_angle * outputs.rolling_radius, SPEED, rtol=ROUNDING)
    assert np.abs(outputs.slip_ratio).max() < DRIFT


def test_the_tires_carry_the_weight_of_the_vehicle(vehicle, after_a_minute):
    total = after_a_minute.outputs.normal_force.sum()
    assert total == pytest.approx(total_weight(vehicle), rel=ROUNDING)


def test_the_axles_share_the_load_by_the_law_of_the_lever(vehicle):
    a, b = vehicle.cg_to_front_axle, vehicle.cg_to_rear_axle
    loads = Simulation(vehicle).outputs.normal_force
    about_the_rear_axle = vehicle.sprung_mass * GRAVITY * b
    about_the_rear_axle += 2 * vehicle.front_unsprung_mass * GRAVITY * (a + b)
    expected = about_the_rear_axle / (a + b)
    assert loads[LF] + loads[RF] == pytest.approx(expected, rel=ROUNDING)
    assert loads[LF] == pytest.approx(loads[RF], rel=ROUNDING)
    assert loads[LR] == pytest.approx(loads[RR], rel=ROUNDING)


def test_the_sprung_mass_stands_at_its_height_on_its_struts_and_wheels(vehicle):
    outputs = Simulation(vehicle).outputs
    height = outputs.strut_length + outputs.loaded_radius
    np.testing.assert_allclose(height, vehicle.cg_height, rtol=ROUNDING)


@pytest.mark.parametrize("no_roll_centre", [False, True])
@pytest.mark.parametrize("euler_terms", [False, True])
def test_nothing_accelerates_at_rest_in_any_variant(
    vehicle, no_roll_centre, euler_terms, steady_state_slip
):
    options = Options(
        no_roll_centre=no_roll_centre,
        euler_terms=euler_terms,
        steady_state_slip=steady_state_slip,
    )
    evaluation = Evaluation(vehicle, options)
    simulation = Simulation(vehicle, options)
    rates = evaluation.rates(simulation.state, Command().records()[0])
    accelerations = ("u", "v", "w", "roll_rate", "pitch_rate", "yaw_rate", "unsprung_velocity")
    largest = max(float(np.abs(rates[name]).max()) for name in accelerations)
    assert largest < DRIFT  # m/s^2, rad/s^2: forces of 1e4 N cancel to 1e-11 N
    assert evaluation.outputs.link_load_transfer == pytest.approx(0.0, abs=DRIFT)


def test_an_accelerometer_at_rest_reads_gravity_upwards(vehicle):
    np.testing.assert_allclose(
        Simulation(vehicle).outputs.specific_force, [0.0, 0.0, GRAVITY], atol=DRIFT
    )
