"""The address of `advance`, for kernels that call it without being compiled with it."""

import functools

import numpy as np

from vehicle_roll_sim.model.compiled.addresses import address_of
from vehicle_roll_sim.model.integration.advance import advance
from vehicle_roll_sim.model.integration.events import LIMITS, no_events
from vehicle_roll_sim.model.integration.integrator import STAGE_VECTORS
from vehicle_roll_sim.model.records import COMMAND, OPTIONS, OUTPUTS, STATE_SIZE, VEHICLE
from vehicle_roll_sim.model.road.layout import PLANE
from vehicle_roll_sim.model.tire.coefficients import TIRES

PLANT = (VEHICLE, TIRES, OPTIONS, LIMITS, COMMAND)
"""The records of a plant as `advance` takes them, before the ground; the last is the zero command.
"""


@functools.cache
def address_of_advance() -> int:
    """The address for all simulations: their arguments have the same types."""
    plant = tuple(np.zeros(1, kind) for kind in PLANT)
    command, plant = np.zeros(1, COMMAND), (*plant, PLANE)
    memory = (np.zeros(1, OUTPUTS), no_events(), np.zeros((STAGE_VECTORS, STATE_SIZE)))
    return address_of(advance, (np.zeros(STATE_SIZE), command, 0, 0, 1, plant, *memory))
