"""Model 2 on swing axles against the multibody engine with real hinges, through lift-off."""

import numpy as np
import pytest
from programmes import ramp_and_hold
from swing_axles import on_swing_axles

from vehicle_roll_sim import Options, Simulation, Vehicle, preset

pytest.importorskip("mujoco", reason="the multibody engine is not installed")
from swing_axle_engine import SwingAxleEngine

pytestmark = pytest.mark.unmeasured

STEP, END, SPEED = 2e-3, 1.2, 50 / 3.6
"""s, s, m/s"""
DEGREES, NEWTONS = 1e-6, 1e-3
"""Seen with half the step: 7e-10 and 3e-6."""


@pytest.fixture(scope="module")
def vehicle() -> Vehicle:
    return on_swing_axles(preset())


def test_a_turn_that_lifts_both_inner_wheels_is_that_of_the_engine(vehicle):
    simulation = Simulation(vehicle, Options(model="2", steady_state_slip=True), step=STEP)
    engine = SwingAxleEngine(vehicle, SPEED)
    programme = ramp_and_hold(0.05, 60.0, 10.0)
    worst = {"roll": 0.0, "loads": 0.0}
    for k in range(round(END / STEP)):
        engine.step(programme, k * STEP, STEP)
        simulation.step(programme, STEP)
        rotation, state = engine.rotation, simulation.state
        roll = np.arctan2(rotation[2, 1], rotation[2, 2])
        loads = engine.outputs["normal_force"] - simulation.outputs["normal_force"]
        worst["roll"] = max(worst["roll"], abs(np.degrees(roll - state.roll)))
        worst["loads"] = max(worst["loads"], np.abs(loads).max())
    assert (simulation.outputs["normal_force"][[0, 2]] == 0.0).all()
    assert worst["roll"] < DEGREES, worst
    assert worst["loads"] < NEWTONS, worst
