"""A turn to the left that lifts the inner wheels, in model 2 and in the multibody engine."""

from collections.abc import Iterator

import numpy as np
from programmes import ramp_and_hold

from vehicle_roll_sim import LF, LR, Simulation

TURN = ramp_and_hold(0.05, 60.0, 10.0)


def differences(simulation: Simulation, engine, step: float, end: float) -> Iterator[tuple]:
    """Drive both; yields the differences of roll (deg) and of loads (N, largest) after each step.

    At the end, both inner wheels must be in the air.
    """
    for k in range(round(end / step)):
        engine.step(TURN, k * step, step)
        simulation.step(TURN, step)
        rotation = engine.rotation
        roll = np.arctan2(rotation[2, 1], rotation[2, 2])
        loads = engine.outputs["normal_force"] - simulation.outputs["normal_force"]
        yield abs(np.degrees(roll - simulation.state.roll)), np.abs(loads).max()
    assert (simulation.outputs["normal_force"][[LF, LR]] == 0.0).all()
