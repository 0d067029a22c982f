"""The actuators of a vehicle as the equations take them, and their memory."""

import math

import numpy as np

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.model.actuators import (
    ACTUATORS,
    BRAKE_TORQUE,
    CHANNELS,
    COMMAND_SIZE,
    END,
    INSTANTS,
    LAG_RATE,
    LIMITED,
    QUEUE,
)
from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.records import COMMAND, WHEEL_COUNT
from vehicle_roll_sim.vehicle.actuator_parameters import (
    MEASURES,
    QUANTITIES,
    has_actuator,
    has_actuators,
    name_of,
)
from vehicle_roll_sim.vehicle.parameters import Vehicle

WHOLE = 1e-6
"""Share of a step by which a dead time may differ from whole steps."""


class Actuation:
    """The actuators of one simulation, and their memory.

    vehicle, step_ns: the vehicle and the integration step (ns). actuators: an array of one
    ACTUATORS record. memory: COMMAND records, see `model.actuators`; none without actuators.
    arguments: both in the form in which `advance_actuated` takes them. Raises InputError for a dead
    time that is not a multiple of the step.
    """

    def __init__(self, vehicle: Vehicle, step_ns: int):
        self.actuators = actuators_of(vehicle, step_ns)
        self.is_present = bool(self.actuators["present"][0])
        rows = QUEUE + INSTANTS * int(self.actuators["slots"][0])
        self.memory = np.zeros(rows if self.is_present else 0, COMMAND)
        numbers = self.memory.view(np.float64).reshape(len(self.memory), COMMAND_SIZE)
        self.arguments = (kernel_argument(self.actuators), self.memory, numbers)

    def rest(self) -> None:
        """Put everything to 0."""
        self.arguments[-1][:] = 0.0

    def records(self) -> np.ndarray:
        """What acts at the end of the last step: an array of one COMMAND record, a copy."""
        return self.memory[END : END + 1].copy()

    def states(self) -> np.ndarray:
        """Output of the rate limiters, state of the lags and its rate (per s), shape (3, CHANNELS).

        A view, at the end of the last step. Rates of lags of first order are 0, as they have none
        of their own; so are values without a lag.
        """
        return self.arguments[-1][LIMITED : LAG_RATE + 1, :CHANNELS]


def actuators_of(vehicle: Vehicle, step_ns: int) -> np.ndarray:
    """The actuators for an integration step (ns), an array of one ACTUATORS record, shape (1,).

    Raises InputError for a dead time that is not a multiple of the step.
    """
    record = _NONE.copy()
    if not has_actuators(vehicle):
        return record
    record["present"] = True
    record["takes_speed_hold"] = has_actuator(vehicle, "wheel_torque")
    for quantity in QUANTITIES:
        _describe(record[0], quantity, vehicle, step_ns)
    record["slots"] = 1 + record["delay"].max()
    return record


def _no_actuators() -> np.ndarray:
    """One ACTUATORS record that changes nothing; brake torques are not negative."""
    record = np.zeros(1, ACTUATORS)
    record["lowest"], record["highest"], record["most_per_half_step"] = -np.inf, np.inf, np.inf
    record["lowest"][0, BRAKE_TORQUE : BRAKE_TORQUE + WHEEL_COUNT] = 0.0
    record["slots"] = 1
    return record


_NONE = _no_actuators()


def _describe(record: np.record, quantity: str, vehicle: Vehicle, step_ns: int) -> None:
    """Fill in the actuator of one quantity."""
    dtype, offset = COMMAND.fields[quantity]
    place = slice(offset // 8, (offset + dtype.itemsize) // 8)
    value = {each: getattr(vehicle, name_of(quantity, each)) for each in MEASURES}
    half = step_ns / 2 / NANOSECONDS
    record["resolution"][place] = value["resolution"] or 0.0
    if value["range"] is not None:
        record["lowest"][place], record["highest"][place] = -value["range"], value["range"]
    if place.start == BRAKE_TORQUE:
        record["lowest"][place] = 0.0
    if value["rate_limit"] is not None:
        record["most_per_half_step"][place] = value["rate_limit"] * half
    if value["dead_time"]:
        record["delay"][place] = _whole(value["dead_time"], step_ns, quantity, vehicle)
    if value["frequency"] is not None:
        damping = 1.0 if value["damping"] is None else value["damping"]
        lag = second_order(2 * math.pi * value["frequency"], damping, half)
    elif value["time_constant"]:
        lag = first_order(value["time_constant"], half)
    else:
        return
    record["has_lag"][place] = 1.0
    for name, number in lag.items():
        record[name][place] = number


def _whole(dead_time: float, step_ns: int, quantity: str, vehicle: Vehicle) -> int:
    """A dead time (s) in steps."""
    steps = dead_time * NANOSECONDS / step_ns
    if abs(steps - round(steps)) > WHOLE:
        name = name_of(quantity, "dead_time")
        allowed = f"a multiple of the step, {step_ns / NANOSECONDS:g} s"
        raise InputError(vehicle.stated_at.get(name, name), dead_time, allowed)
    return round(steps)


def first_order(time_constant: float, interval: float) -> dict[str, float]:
    """Fields of ACTUATORS for T x' + x = u (T in s), over an interval (s) with linear u."""
    return {
        "value_by_value": math.exp(-interval / time_constant),
        "value_by_ramp": time_constant / interval * math.expm1(-interval / time_constant),
    }


def second_order(frequency: float, damping: float, interval: float) -> dict[str, float]:
    """The same for x'' + 2 D w x' + w² x = w² u, with w = frequency (rad/s), D = damping."""
    decay, turn = damping * frequency, frequency * math.sqrt(abs(1.0 - damping**2))
    angle = turn * interval
    if damping < 1.0:
        size = math.exp(-decay * interval)
        cosine, sine = size * math.cos(angle), size * math.sin(angle) / turn
    elif damping > 1.0:  # decay less turn, without cancellation
        size = math.exp(-(frequency**2) / (decay + turn) * interval)
        cosine = size * (1.0 + math.exp(-2.0 * angle)) / 2.0
        sine = -size * math.expm1(-2.0 * angle) / (2.0 * turn)
    else:
        cosine = math.exp(-decay * interval)
        sine = interval * cosine
    by_value, by_rate = cosine + decay * sine, sine
    rate_by_value, rate_by_rate = -(frequency**2) * sine, cosine - decay * sine
    behind = 2.0 * damping / frequency
    return {
        "value_by_value": by_value,
        "value_by_rate": by_rate,
        "value_by_ramp": ((by_value - 1.0) * behind - by_rate) / interval,
        "rate_by_value": rate_by_value,
        "rate_by_rate": rate_by_rate,
        "rate_by_ramp": (1.0 + rate_by_value * behind - rate_by_rate) / interval,
    }
