"""The memory of drivers: with it another one goes on to the bit; what cannot be kept is refused."""

import copy
import json

import numpy as np
import pytest
from signals import everything

from vehicle_roll_sim import Command, Feedback, InputError, Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.simulation.command import command_at
from vehicle_roll_sim.simulation.memory import Remembering

PERIOD = 0.02
DRIVEN = {
    "nhtsa_fishhook": 60,
    "iso_double_lane_change": 60,
    "iso_severe_double_lane_change": 60,
    "constant_radius_circle": 60,
    "constant_handwheel_circle": 60,
}
"""Manoeuvres whose commands react to the vehicle, and periods of 20 ms until the snapshot."""


def drive(simulation, driver, periods: int) -> list:
    seen = []
    for _ in range(periods):
        command = command_at(driver, simulation.time, simulation.state)
        simulation.step(command, PERIOD)
        seen.append((command, everything(simulation)))
    return seen


def test_these_are_all_manoeuvres_with_a_driver():
    vehicle, options = preset(), Options()
    ready = {name: each.for_vehicle(vehicle, options) for name, each in STANDARD.items()}
    assert set(DRIVEN) == {n for n, each in ready.items() if isinstance(each.driver(), Feedback)}


@pytest.mark.parametrize(("name", "periods"), DRIVEN.items())
def test_a_driver_with_the_memory_of_another_goes_on_like_it(name, periods):
    vehicle, options = preset(), Options()
    manoeuvre = STANDARD[name].for_vehicle(vehicle, options)
    simulation, driver = Simulation(vehicle, options), manoeuvre.driver()
    simulation.reset(manoeuvre.speed)
    drive(simulation, driver, periods)
    kept, memory = simulation.snapshot(), json.loads(json.dumps(driver.memory()))
    straight = drive(simulation, driver, 20)
    branch = manoeuvre.driver()
    branch.remember(memory)
    assert drive(Simulation.from_snapshot(kept, vehicle, options), branch, 20) == straight


class Part(Remembering):
    def __init__(self):
        self.count, self.seen, self.pair = 0, [], (1.0, 2.0)
        self.flag, self.nothing, self.texts = np.bool_(True), None, {"a": [1]}


def test_a_memory_is_a_copy_and_keeps_every_kind_of_plain_data():
    part = Part()
    memory = part.memory()
    before = copy.deepcopy(memory)
    part.seen.append(np.float64(0.1))
    part.texts["a"].append(2)
    assert memory == before
    other = Part()
    other.remember(json.loads(json.dumps(part.memory())))
    assert vars(other) == vars(part)
    assert isinstance(other.pair, tuple)


class Learner(Feedback):
    def __init__(self):
        self.weights = np.zeros(3)

    def command(self, time, state):
        return Command()


def test_what_is_no_plain_data_is_refused_by_its_name():
    with pytest.raises(InputError, match=r"Learner\.weights.*plain data, or an object with"):
        Learner().memory()


def test_the_memory_of_another_kind_of_object_is_refused():
    with pytest.raises(InputError, match="that of a Part"):
        Part().remember({"count": 1})
