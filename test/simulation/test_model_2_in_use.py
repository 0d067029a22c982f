"""What works with model 1 works with model 2, and for the reference vehicle nearly alike."""

import copy

import numpy as np
import pytest

from vehicle_roll_sim import Command, Options, Road, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.runs.run import run

BRAKED = Command(brake_torque=(3000.0,) * 4)
UNLIKE = 0.1
"""Difference of the roll angle between the models over its peak: at most 0.083."""


def driven(name: str, model: str):
    simulation, manoeuvre = Simulation(preset(), Options(model=model)), STANDARD[name]
    simulation.reset(manoeuvre.speed)
    manoeuvre = manoeuvre.for_vehicle(simulation.vehicle, simulation.options)
    return run(simulation, manoeuvre.driver(), 1.6)


@pytest.mark.parametrize("name", STANDARD)
def test_a_manoeuvre_is_driven_nearly_as_with_model_1(name):
    roll, other = (driven(name, model)["roll"] for model in "21")
    assert len(roll) == len(other)
    assert np.abs(roll - other).max() < UNLIKE * np.abs(other).max()


def test_it_stands_on_a_slope_with_its_brakes_on():
    simulation = Simulation(preset(), Options(model="2"), road=Road(grade=0.1, bank=0.1))
    simulation.reset(0.0)
    simulation.step(BRAKED, 10.0)
    state = simulation.state
    assert np.abs([state.u, state.v]).max() < 1e-5  # m/s
    assert np.hypot(state.x, state.y) < 0.03  # m: the tires and springs have given way


def test_brakes_stop_it_where_they_stop_model_1():
    stops = []
    for model in "12":
        simulation = Simulation(preset(), Options(model=model))
        simulation.reset(20.0)
        simulation.step(Command(brake_torque=(600.0, 600.0, 300.0, 300.0)), 8.0)
        assert abs(simulation.state.u) < 0.01  # m/s
        stops.append(float(simulation.state.x))
    assert stops[1] == pytest.approx(stops[0], rel=1e-3)


def test_it_rolls_over_and_a_snapshot_of_it_goes_on_to_the_bit():
    simulation = Simulation(preset(), Options(model="2"))
    simulation.step(Command(steering=0.2), 0.5)
    other = copy.deepcopy(simulation)
    for each in (simulation, other):
        each.step(Command(steering=0.2), 3.0)
        assert each.condition is Condition.ROLLED_OVER
    assert simulation.state_vector.tobytes() == other.state_vector.tobytes()
