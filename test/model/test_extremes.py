"""Wheels far beyond grip, very low speeds, parking: finite states, and forces that oppose slip."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import Command, Condition, Options, Simulation
from vehicle_roll_sim.model.records import LR
from vehicle_roll_sim.simulation.road import Road

SPINNING = {"forwards": (10.0, 5000.0), "backwards": (10.0, -5000.0), "from rest": (0.0, 5000.0)}
"""Speed (m/s) and torque at each rear wheel (N m), some four times what the tires can carry."""


def finite(simulation) -> bool:
    return bool(np.isfinite(simulation.model_state).all())


@pytest.mark.parametrize("model", ["1", "8dof"])
@pytest.mark.parametrize("case", SPINNING)
def test_a_torque_far_beyond_grip_spins_the_wheels_and_their_force_opposes_the_slip(
    reference, model, case
):
    speed, torque = SPINNING[case]
    simulation = Simulation(reference, Options(model=model))
    simulation.reset(speed)
    assert simulation.step(Command(wheel_torque=(0.0, 0.0, torque, torque)), 0.3) is (
        Condition.RUNNING
    )
    rear = slice(LR, None)
    slipping = simulation.state.wheel_speed[rear] * reference.tire_radius - simulation.state.u
    force = simulation.outputs.longitudinal_force[rear]
    assert (np.abs(slipping) > 20.0).all()  # m/s: it spins
    assert (np.sign(force) == math.copysign(1.0, torque)).all()
    assert (np.sign(slipping) == np.sign(force)).all()
    assert (np.abs(force) < 1.2 * simulation.outputs.normal_force[rear]).all()  # grip
    assert finite(simulation)


@pytest.mark.parametrize("model", ["1", "8dof"])
@pytest.mark.parametrize("speed", [0.0, 1e-12, -1e-12, 1e-6, -1e-6, 1e-3, -1e-3, 0.1, 1.0, -1.0])
def test_next_to_standstill_nothing_divides_by_the_speed(reference, model, speed):
    """Steered, so that slips across are there too; it goes no faster than it began."""
    simulation = Simulation(reference, Options(model=model))
    simulation.reset(0.0)
    simulation.state.u = speed
    simulation.state.wheel_speed = speed / simulation.outputs.loaded_radius
    assert simulation.step(Command(steering=0.3), 5.0) is Condition.RUNNING
    assert finite(simulation)
    assert abs(simulation.state.u) <= abs(speed) + 1e-9  # m/s of rounding


@pytest.mark.parametrize("steering", [0.0, 0.5, -0.5])
def test_parked_on_a_bank_with_brakes_on_it_creeps_less_than_a_millimetre_in_a_minute(
    reference, steering
):
    simulation = Simulation(reference, road=Road(bank=0.15))
    simulation.reset(0.0)
    parked = Command(steering=steering, brake_torque=(3000.0,) * 4)
    simulation.step(parked, 20.0)  # it settles on its tires
    begin = simulation.state.copy()
    assert simulation.step(parked, 60.0) is Condition.RUNNING
    assert math.hypot(simulation.state.x - begin.x, simulation.state.y - begin.y) < 1e-3


def test_a_day_of_simulated_time_is_counted_to_the_nanosecond(reference):
    """However late it is, a step is a step: the state does not depend on the time."""
    early, late = Simulation(reference), Simulation(reference)
    late.time_ns = 24 * 3600 * 10**9
    for simulation in (early, late):
        simulation.step(Command(steering=0.02), 0.1)
    assert late.time_ns - 24 * 3600 * 10**9 == early.time_ns == 100_000_000
    assert late.state.tobytes() == early.state.tobytes()
