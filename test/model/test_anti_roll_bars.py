"""Anti-roll bars in the models of the paper: in roll a stiffer spring, otherwise nothing."""

import numpy as np
import pytest
from programmes import SOURCE, Evaluation, ramp_and_hold
from random_states import random_command, random_state

from vehicle_roll_sim import Command, Options, Simulation
from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.records import OPTIONS
from vehicle_roll_sim.model.roll_axis import roll_stiffness
from vehicle_roll_sim.simulation.plant import Plant

RATE = 9_000.0
"""N/m"""
BARS = {"front_anti_roll_bar_rate": RATE, "rear_anti_roll_bar_rate": RATE / 2}


def springs_stiffer_in_roll(vehicle):
    """What the bars are to a body that only rolls: 2 RATE on every spring."""
    return vehicle.with_values(
        {
            "front_spring_stiffness": vehicle.front_spring_stiffness + 2 * RATE,
            "rear_spring_stiffness": vehicle.rear_spring_stiffness + RATE,
        }
    )


@pytest.mark.parametrize("model", ["1", "1b", "2"])
def test_a_bar_presses_down_the_wheel_that_is_up_and_lifts_the_other(unequal_axles, model):
    rng, options = np.random.default_rng(3), Options(model=model, steady_state_slip=True)
    with_bars = Evaluation(unequal_axles.with_values(BARS), options)
    without = Evaluation(unequal_axles, options)
    state, command = random_state(unequal_axles, rng), random_command(rng)
    with_bars.rates(state, command)
    without.rates(state, command)
    lf, rf, lr, rr = state["suspension_compression"]
    front, rear = RATE * (lf - rf), RATE / 2 * (lr - rr)
    more = with_bars.outputs["strut_force"] - without.outputs["strut_force"]
    np.testing.assert_allclose(more, [front, -front, rear, -rear], rtol=1e-9)


def test_in_the_8_dof_model_it_is_a_stiffer_spring(reference):
    options = Options(model="8dof")
    bars = Simulation(reference.with_values(BARS), options)
    stiffer = Simulation(springs_stiffer_in_roll(reference), options)
    turn = ramp_and_hold(0.2, 20.0, 3.0)
    for simulation in (bars, stiffer):
        simulation.step(turn, 1.5)
    assert bars.state.roll == pytest.approx(stiffer.state.roll, rel=1e-12)
    np.testing.assert_allclose(
        bars.outputs["normal_force"], stiffer.outputs["normal_force"], rtol=1e-12
    )


def test_the_roll_stiffness_of_roll_plane_models_counts_them(reference):
    """With hard tires it is that of the springs and c^2 RATE."""
    hard = {"front_tire_stiffness": 1e8, "rear_tire_stiffness": 1e8}
    flags = np.zeros(1, OPTIONS)[0]
    stiffness = [
        roll_stiffness(kernel_argument(Plant.of(vehicle, SOURCE).vehicle)[0], flags)
        for vehicle in (reference.with_values(hard), reference.with_values(hard | BARS))
    ]
    assert stiffness[1] - stiffness[0] == pytest.approx(1.5**2 * 1.5 * RATE, rel=3e-3)


@pytest.mark.parametrize("model", ["1", "2"])
def test_the_body_rolls_less_and_neither_heaves_nor_sinks_at_rest(reference, model):
    rolls = []
    for vehicle in (reference, reference.with_values(BARS)):
        simulation = Simulation(vehicle, Options(model=model))
        height = simulation.state.z
        simulation.step(Command(), 1.0)
        assert simulation.state.z == pytest.approx(height, abs=1e-9)
        simulation.step(Command(steering=0.03), 2.0)
        rolls.append(simulation.state.roll)
    assert 0.0 < rolls[1] < 0.85 * rolls[0]
