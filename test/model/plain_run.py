"""A run in a process of its own: python plain_run.py STEPS FILE [without-numba | 8dof | steady].

Saves the STATE and OUTPUTS records after every step of a J-turn, and how the model ran.
"""

import sys

if sys.argv[3:] == ["without-numba"]:
    sys.modules["numba"] = None  # importing it now fails

import numpy as np
from programmes import j_turn, record_run

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.model import jit

STEP = 0.001
"""s"""
HELD = {
    "wheel_torque": (0.0, 50.0, 120.0, -80.0),
    "brake_torque": (40.0, 0.0, 10.0, 20.0),
    "normal_force": (100.0, 0.0, -200.0, 300.0),
}
FULL = Options(euler_terms=True)
OPTIONS = {
    "8dof": Options(model="8dof"),
    "steady": Options(euler_terms=True, steady_state_slip=True),
}


def run(steps: int, options: Options = FULL):
    simulation = Simulation(preset(), options, step=STEP)
    return record_run(simulation, j_turn(**HELD), steps * STEP)


if __name__ == "__main__":
    result = run(int(sys.argv[1]), OPTIONS.get("".join(sys.argv[3:]), FULL))
    np.savez(sys.argv[2], state=result.state, outputs=result.outputs, how=jit.describe())
