"""The driving task of the model benchmarks: the reference vehicle in a slalom."""

import time

import numpy as np

from vehicle_roll_sim import Options, Road, Simulation, Vehicle, preset
from vehicle_roll_sim.model.compiled.addresses import caller_of
from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.integration.derivatives import derivatives_at
from vehicle_roll_sim.model.records import COMMAND

SPEED = 20.0
"""m/s"""
AMPLITUDE, PERIOD = np.radians(2.0), 2.5
"""rad and s, of the front steering."""
SLIPS = {"transient": Options(), "steady-state": Options(steady_state_slip=True)}
"""Model 1, by the kind of slip."""


def slalom(times: np.ndarray, torque: float = 0.0) -> np.ndarray:
    """COMMAND records: steering, and a torque at each wheel at twice the frequency.

    times: s, shape (n,). torque: amplitude, N m. Returns shape (n,).
    """
    commands = np.zeros(len(times), COMMAND)
    phase = 2 * np.pi * times / PERIOD
    commands["steering"] = AMPLITUDE * np.sin(phase)
    commands["wheel_torque"] = torque * np.sin(2 * phase)[:, None]
    return commands


def slalom_start(
    options: Options,
    step: float = 1e-3,
    vehicle: Vehicle | None = None,
    road: Road | None = None,
) -> Simulation:
    """At the entry of the slalom, by default in the reference vehicle on a level road.

    The step may be too large, to show the effect.
    """
    simulation = Simulation(vehicle or preset(), options, step=step, road=road, check_step=False)
    simulation.reset(SPEED)
    return simulation


evaluate_one = caller_of(derivatives_at)


@kernel
def evaluate(address, states, commands, plant, outputs, rates):
    """Evaluate the derivatives at each state with its command; `rates` keeps those of the last.

    address: of `derivatives_at` for these arguments.
    """
    for k in range(len(states)):
        one = commands[k : k + 1]
        evaluate_one(address, (states[k], one, plant, outputs, rates, False))


def repeated(call, repetitions: int, prepare=lambda: None) -> np.ndarray:
    """The time (s) that each call of `call` takes, without the preceding call of `prepare`."""
    took = np.empty(repetitions)
    for i in range(repetitions):
        prepare()
        begun = time.perf_counter()
        call()
        took[i] = time.perf_counter() - begun
    return took
