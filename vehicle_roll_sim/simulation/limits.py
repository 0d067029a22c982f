"""The limits of a simulation: ranges of its arguments, and the states at which a run stops."""

import math

import numpy as np

from vehicle_roll_sim.input_errors import InputError, number_of
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import LIMITS, MINIMUM_SPEED, plausible_magnitudes
from vehicle_roll_sim.model.records import MODEL_STATE, SLIP_STATES
from vehicle_roll_sim.simulation.options import Options

DEFAULT_STEP, SHORTEST_STEP = 0.001, 1e-6
"""s"""
DEFAULT_SPEED = 50 / 3.6
"""m/s: 50 km/h, as in the manoeuvres of the paper."""
MAXIMUM_SPEED = 100.0
"""m/s"""
DEFAULT_ROLLOVER_DEGREES = 85.0
DEFAULT_ROLLOVER_ANGLE = math.radians(DEFAULT_ROLLOVER_DEGREES)
ROLLOVER_ANGLES = (1e-6, math.pi / 2)
"""rad: allowed range of the rollover angle."""


def whole_steps(duration: float, step_ns: int, field: str) -> int:
    """The number of steps in `duration` (s); raises InputError naming `field` if not whole."""
    allowed = f"a multiple of the step, {step_ns / NANOSECONDS:g} s"
    duration = number_of(duration, field, allowed)
    wanted = duration * NANOSECONDS / step_ns if math.isfinite(duration) else math.nan
    if not wanted >= 1 - 1e-6 or abs(wanted - round(wanted)) > 1e-6 * max(1.0, wanted / 1e6):
        raise InputError(field, duration, allowed)
    return round(wanted)


def within(field: str, value, least: float, most: float, unit: str) -> float:
    """Return `value` as a float if it is within the range; raises InputError naming `field`."""
    allowed = f"a number from {least:g} to {most:g} {unit}"
    number = number_of(value, field, allowed)
    if not least <= number <= most:
        raise InputError(field, value, allowed)
    return number


def slowest(options: Options) -> float:
    """Smallest speed (m/s) at which a run may start."""
    return MINIMUM_SPEED if options.steady_state_slip else 0.0


def absent_states(options: Options) -> list[str]:
    """The fields of records.STATE that the model does not have."""
    return [name for name in (*MODEL_STATE.names, *SLIP_STATES) if name not in options.states]


def limits_of(options: Options, rollover_angle: float) -> np.ndarray:
    """An array of one LIMITS record, shape (1,): the states at which a run stops.

    rollover_angle: rad; a run does not stop there if the body may touch the ground.
    """
    limits, goes_on = np.zeros(1, LIMITS), options.body_contact
    limits["rollover_angle"] = rollover_angle
    limits["stop_angle"] = math.inf if goes_on else rollover_angle
    limits["minimum_speed"] = slowest(options) or -math.inf
    largest = plausible_magnitudes()
    for name in absent_states(options):
        largest[name] = np.nan
    if goes_on:
        largest["roll"] = largest["yaw"]
    limits["largest"] = largest.view(np.float64)
    return limits
