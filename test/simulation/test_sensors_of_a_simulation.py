"""Sensors of a simulation change no bit of it, and survive steps, copies, snapshots and resets."""

import math
import pickle

import numpy as np
import pytest
from measured import measured

from vehicle_roll_sim import Command, InputError, Simulation, preset
from vehicle_roll_sim.vehicle.sensor_parameters import DEVICES

TURN = Command(steering=0.04)


def truth_of(simulation: Simulation) -> dict[str, list]:
    state, outputs = simulation.state, simulation.outputs
    rates = [state.roll_rate, state.pitch_rate, state.yaw_rate]
    return {
        "accelerometer": outputs.specific_force.tolist(),
        "gyro": rates,
        "wheel_speed": state.wheel_speed.tolist(),
        "steering": outputs.steering.tolist(),
        "odom_position": [state.x, state.y, state.z],
        "odom_velocity": [state.u, state.v, state.w],
        "odom_rate": rates,
    }


def test_sensors_without_errors_read_the_truth_and_change_no_bit_of_it():
    plain = Simulation(preset())
    exact = Simulation(preset().with_values({f"{device}_period": 0.01 for device in DEVICES}))
    for simulation in (plain, exact):
        simulation.reset(25.0)
        simulation.step(TURN, 0.4)
    assert plain.state.tobytes() == exact.state.tobytes()
    assert plain.outputs.tobytes() == exact.outputs.tobytes()
    assert {name: exact.sensors[name].tolist() for name in truth_of(exact)} == truth_of(exact)
    with pytest.raises(KeyError):
        plain.sensors["gyro"]


def programme(times: np.ndarray) -> np.ndarray:
    return np.concatenate([Command(steering=0.1 * math.sin(3 * t)).records() for t in times])


@pytest.mark.parametrize("command", [TURN, programme])
def test_it_does_not_matter_how_many_steps_are_made_at_once(command):
    one, other, plain = Simulation(measured()), Simulation(measured()), Simulation(preset())
    one.step(command, 0.3)
    plain.step(command, 0.3)
    for _ in range(100):
        other.step(command, 0.003)
    assert (one.sensors.readings() == other.sensors.readings()).all()
    assert one.state.tobytes() == other.state.tobytes() == plain.state.tobytes()


@pytest.mark.parametrize("copied", ["snapshot", "pickle"])
def test_a_simulation_with_sensors_goes_on_to_the_bit(copied):
    simulation = Simulation(measured())
    simulation.step(TURN, 0.234)
    if copied == "snapshot":
        other = Simulation(measured())
        other.step(Command(steering=-0.02), 0.7)
        other.restore(pickle.loads(pickle.dumps(simulation.snapshot())))
    else:
        other = pickle.loads(pickle.dumps(simulation))
    before = simulation.sensors.readings()
    for each in (simulation, other):
        each.step(TURN, 0.4)
    assert (simulation.sensors.readings() == other.sensors.readings()).all()
    assert (simulation.sensors.readings() != before).any()


def test_a_snapshot_of_other_sensors_is_refused():
    given = Simulation(measured()).snapshot()
    with pytest.raises(InputError, match="taken from a different simulation"):
        Simulation(measured(gyro_bias_z=0.02)).restore(given)


def test_a_reset_begins_the_noise_again():
    simulation = Simulation(measured())
    runs = []
    for _ in range(2):
        simulation.reset(20.0)
        simulation.step(TURN, 0.3)
        runs.append(simulation.sensors.readings().tolist())
    assert runs[0] == runs[1]
