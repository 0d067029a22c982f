"""The equations against an independent multibody engine: accelerations, then the J-turn.

Comparable are the variants in which the engine's bodies are the model's: no roll centre, Euler
terms on, tires without longitudinal force (the engine's wheels do not spin).
"""

import numpy as np
import pytest
from programmes import LATERAL_ONLY, Evaluation, j_turn, with_tire
from random_states import attitude, random_command, random_state, wheel_positions

from vehicle_roll_sim import Condition, Options, Simulation

mujoco = pytest.importorskip("mujoco", reason="the multibody engine is not installed")
from multibody import Multibody  # noqa: E402  needs mujoco

COMPARABLE = Options(no_roll_centre=True, euler_terms=True)
STATES = 200
RELATIVE = 1e-10
"""Of the largest acceleration: rounding, and the engine's point masses that are not quite points,
1e-12; seen 4e-12."""
STEP = 1e-3
"""s"""
ROLL_TOLERANCE = 1e-6
"""Degrees. Both are integrated to fourth order, but in different coordinates: seen 4e-9 at 1 ms,
3e-10 at half of it."""
LOAD_TOLERANCE = 1e-3
"""N, likewise: seen 1e-5."""


@pytest.fixture
def on_lateral_tires(vehicle):
    return with_tire(vehicle, **LATERAL_ONLY)


def accelerations(vehicle, state, rates) -> np.ndarray:
    """The model's, as the engine has them: c.g. over the ground, body rates, slides."""
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    velocity = np.array([state["u"], state["v"], state["w"]])
    turning = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
    in_body = np.array([rates["u"], rates["v"], rates["w"]]) + np.cross(turning, velocity)
    spinning = np.array([rates["roll_rate"], rates["pitch_rate"], rates["yaw_rate"]])
    x, y = wheel_positions(vehicle).T
    at_strut = rates["w"] + y * rates["roll_rate"] - x * rates["pitch_rate"]
    return np.concatenate([rotation @ in_body, spinning, rates["unsprung_velocity"] - at_strut])


def test_accelerations_at_random_states_are_those_of_the_engine(on_lateral_tires):
    engine = Multibody(on_lateral_tires)
    evaluation = Evaluation(on_lateral_tires, COMPARABLE)
    rng = np.random.default_rng(11)
    for _ in range(STATES):
        state, command = random_state(on_lateral_tires, rng), random_command(rng)
        command["rear_steering"] = 0.0
        rates = evaluation.rates(state, command)
        engine.place(state)
        theirs = engine.accelerate(command["steering"], command["normal_force"])
        mine = accelerations(on_lateral_tires, state, rates)
        # N: where a load is 0 on one side it must be on the other, up to rounding of the height
        np.testing.assert_allclose(
            evaluation.outputs.normal_force, engine.tire_load, rtol=1e-9, atol=1e-7
        )
        assert np.abs(mine - theirs).max() < RELATIVE * np.abs(theirs).max(), state


def both_through_the_turn(vehicle):
    """Roll (deg) and tire loads (N) of model and engine after every step, until rolled over."""
    turn = j_turn()
    simulation, engine = Simulation(vehicle, COMPARABLE, step=STEP), Multibody(vehicle)
    engine.place(simulation.state)
    rolls, loads = [], []

    def steering(time):
        return float(turn(np.array([time]))["steering"][0])

    while simulation.condition is Condition.RUNNING and simulation.time < 6.0:
        engine.step(simulation.time, STEP, steering)
        simulation.step(turn, STEP)
        engine.accelerate(steering(simulation.time))
        rolls.append((simulation.state.roll, engine.roll))
        loads.append((simulation.outputs.normal_force.copy(), engine.tire_load.copy()))
    return np.degrees(rolls), np.array(loads), simulation


def test_the_j_turn_to_rollover_is_that_of_the_engine(reference):
    rolls, loads, simulation = both_through_the_turn(with_tire(reference, **LATERAL_ONLY))
    assert simulation.condition is Condition.ROLLED_OVER
    assert np.isfinite(simulation.events.lift_off_time).all()  # every wheel leaves the ground
    assert np.abs(rolls[:, 0] - rolls[:, 1]).max() < ROLL_TOLERANCE
    assert np.abs(loads[:, 0] - loads[:, 1]).max() < LOAD_TOLERANCE
