"""Calls of the compiled loop that drives a simulation for many periods."""

import numpy as np

from vehicle_roll_sim.model.compiled.jit import interruptible, silently
from vehicle_roll_sim.model.integration.actuated import advance_actuated
from vehicle_roll_sim.model.integration.drive import CLOCK_SIZE, NOW, STEP, WATCH_SIZE, drive
from vehicle_roll_sim.model.records import COMMAND, MODEL_STATE_SIZE
from vehicle_roll_sim.simulation.advance_address import address_of_advance
from vehicle_roll_sim.simulation.simulation import Simulation


def drive_on(
    simulation: Simulation,
    commands: np.ndarray,
    held: np.ndarray,
    clock: np.ndarray,
    watch: np.ndarray,
    places: np.ndarray,
    rows: np.ndarray,
    driven: np.ndarray,
) -> tuple[int, bool]:
    """Move a simulation as `drive` does, which explains the arguments.

    Returns the number of rows written, and whether the watched roll rate has dropped.
    """
    state, plant, outputs, events, stages = simulation.parts()
    vectors = (simulation.output_vector, events, stages, simulation.actuation.arguments)
    parts = (state, plant, outputs, *vectors)
    clock[STEP] = simulation.step_ns
    arguments = (address_of_advance(), parts, commands, held, clock, watch, places, rows, driven)
    with silently():  # divergence is detected from the result
        count, condition, culprit, has_dropped = interruptible(drive, arguments)
    simulation.note_moved(int(clock[NOW]), condition, culprit)
    return count, has_dropped


def compile_loop(simulation: Simulation) -> None:
    """Have the loop compiled, or loaded from the cache; the simulation does not move."""
    one, places = np.zeros(1, COMMAND), np.zeros(1, int)
    rows, clock = np.empty((1, 1 + MODEL_STATE_SIZE + 1)), np.zeros(CLOCK_SIZE, np.int64)
    clock[NOW] = simulation.time_ns
    drive_on(simulation, one, one, clock, np.zeros(WATCH_SIZE), places, rows, one)


def compile_actuators(simulation: Simulation) -> None:
    """The same for the integration with actuators."""
    state, *others = simulation.parts()
    arguments = (state, np.zeros(1, COMMAND), 0, simulation.time_ns, simulation.step_ns, *others)
    advance_actuated(address_of_advance(), arguments, simulation.actuation.arguments)
