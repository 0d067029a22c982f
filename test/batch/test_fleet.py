"""A fleet gives the bits of simulations that are stepped one by one."""

import copy
import pickle

import numpy as np
import pytest
from actuated import actuated
from measured import measured
from road_kinds import ROADS

from vehicle_roll_sim import Command, Condition, InputError, Options, Simulation, preset
from vehicle_roll_sim.batch.fleet import Fleet
from vehicle_roll_sim.model.variants import MODELS

STEP = 0.0025
STEP_NS = 2_500_000
TURN = Command(steering=0.15, brake_torque=(300.0, 0.0, 0.0, 0.0))
PUSH = Command(rear_steering=-0.02, wheel_torque=(0.0, 0.0, 200.0, 200.0), normal_force=(9e2,) * 4)


def fleet_of(simulations: list[Simulation], workers: int) -> Fleet:
    fleet = Fleet(len(simulations), STEP_NS, workers)
    for i, each in enumerate(simulations):
        fleet.place(i, each)
    return fleet


@pytest.mark.parametrize("workers", [1, 2])
def test_a_fleet_gives_the_bits_of_simulations_with_their_own_models_and_commands(workers):
    options = [Options(model=name) for name in MODELS] + [Options(steady_state_slip=True)]
    simulations = [Simulation(preset("suv"), each, step=STEP) for each in options]
    late = {"rear_steering_actuator_dead_time": 0.02, "brake_torque_actuator_dead_time": 0.0}
    for longest in (0.01, 0.1):
        delayed = actuated(**late | {"steering_actuator_dead_time": longest})
        simulations.append(Simulation(delayed, step=STEP))
    clocks = {"wheel_speed_sensor_period": 0.005}
    simulations += [Simulation(measured(**clocks, imu_delay=late), step=STEP) for late in (0, 0.03)]
    simulations.append(Simulation(measured(**clocks), step=STEP, road=ROADS["curb"]))
    for name in ("random profile", "curb", "random profile"):
        simulations.append(Simulation(preset("suv"), step=STEP, road=ROADS[name]))
    simulations.append(Simulation(preset("van"), step=STEP, rollover_angle=0.03))
    for each in simulations:
        each.reset(22.0)
    fleet = fleet_of(simulations, workers)
    given = [TURN, PUSH] * len(fleet)
    given = [*given[: len(fleet) - 1], TURN]
    records = np.concatenate([each.records() for each in given])
    for _ in range(25):
        for each, command in zip(simulations, given, strict=True):
            each.step(command, 4 * STEP)
        fleet.step(records, np.full(len(fleet), 4))
    for i, each in enumerate(simulations):
        assert fleet.states[i].tobytes() == each.state.tobytes()
        assert fleet.outputs[i].tobytes() == each.outputs.tobytes()
        assert fleet.events[i].tobytes() == each.events.tobytes()
        assert (fleet.times[i], fleet.conditions[i]) == (each.time, each.condition)
        if each.has_sensors:
            assert (fleet.sensors[i].readings() == each.sensors.readings()).all()
    assert {*fleet.conditions.tolist()} == {Condition.RUNNING, Condition.ROLLED_OVER}
    fleet.close()


def test_a_place_without_steps_is_left_alone():
    simulation = Simulation(preset(), step=STEP)
    fleet = fleet_of([simulation, simulation], 1)
    records = np.repeat(TURN.records(), 2)
    fleet.step(records, np.array([0, 4]))
    assert fleet.states[0].tobytes() == simulation.state.tobytes() != fleet.states[1].tobytes()
    assert fleet.times.tolist() == [0.0, 4 * STEP]


def test_a_number_of_threads_that_is_none_is_refused():
    with pytest.raises(InputError, match=r"^workers: 0 is not allowed: a whole number"):
        Fleet(1, STEP_NS, 0)


def test_a_simulation_with_another_step_has_no_place():
    with pytest.raises(InputError, match=r"^step: 0.001 is not allowed: 0.0025 s, the step of the"):
        Fleet(1, STEP_NS, 1).place(0, Simulation(preset(), step=0.001))


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda fleet: pickle.loads(pickle.dumps(fleet))])
def test_a_copied_fleet_goes_on_by_itself_to_the_same_bits(copied):
    simulation = Simulation(preset(), step=STEP)
    simulation.reset(22.0)
    fleet = fleet_of([simulation, simulation], 2)
    records, steps = np.repeat(TURN.records(), 2), np.full(2, 4)
    fleet.step(records, steps)
    other, before = copied(fleet), fleet.states.tobytes()
    other.step(records, steps)
    assert fleet.states.tobytes() == before
    fleet.step(records, steps)
    assert other.states.tobytes() == fleet.states.tobytes() == other.state_vectors.tobytes()
    fleet.close()
    other.close()
