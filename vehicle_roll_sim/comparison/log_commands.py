"""The commands of a log, one for each period in which the model is driven."""

import dataclasses

import numpy as np

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.log import Log
from vehicle_roll_sim.logs.quantities import SPEED, TORQUES
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.records import WHEEL_COUNT, WHEELS
from vehicle_roll_sim.simulation.speed_controller import SpeedController
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.steering_gear import to_road_wheels

PERIOD = 0.002
"""s: commands are those of the middle of such a period, so that holding them delays nothing."""


@dataclasses.dataclass(frozen=True)
class Plan:
    """When a log drives a model.

    period: s. steps: of the integration, in each period. ahead: periods before the log begins.
    instants: ends of the periods, from the start on, and middles, both in time of the log (s).
    """

    period: float
    steps: int
    ahead: int
    instants: np.ndarray
    middles: np.ndarray

    @classmethod
    def of(cls, log: Log, run_up: float, step_ns: int) -> "Plan":
        """The plan for a log. run_up: s."""
        step = step_ns / NANOSECONDS
        steps = max(1, round(PERIOD / step))
        period = steps * step
        ahead = round(run_up / period)
        count = ahead + int(np.ceil((log.time[-1] - log.time[0]) / period - 1e-6))
        middles = (np.arange(count) - ahead + 0.5) * period + log.time[0]
        ends = np.arange(count + 1) * steps * step_ns / NANOSECONDS
        return cls(period, steps, ahead, ends - ahead * period + log.time[0], middles)

    @property
    def periods(self) -> int:
        """How many periods there are, with those of the run-up."""
        return len(self.middles)


class LogCommands:
    """The commands of a log for a vehicle, one for each period of a plan.

    Attributes: steering, rear_steering (road wheels, rad) and speeds (m/s), (n,); wheel_torques,
    brake_torques (N m), (n, 4); is_held: whether the controller holds the speed, (n,); unused:
    quantities of the log that do not drive the model. Raises InputError.
    """

    def __init__(self, log: Log, vehicle: Vehicle, holds_speed: bool, plan: Plan):
        given = {name: np.interp(plan.middles, *channel) for name, channel in log.inputs.items()}
        torques = [name for name in given if name in TORQUES]
        self.is_held = np.arange(plan.periods) < plan.ahead
        if holds_speed:
            self.is_held[:] = True
        elif not torques:
            allowed = "drive_torque, brake or those of wheels in the log"
            raise InputError("drive_by", "torques", allowed)
        self.unused = torques if holds_speed else []
        self.speeds, self.steering = given[SPEED], given.get("steering")
        if self.steering is None:
            degrees = to_road_wheels(np.degrees(given["handwheel"]), vehicle.gear)
            self.steering = np.radians(degrees)
        self.rear_steering = given.get("rear_steering", np.zeros(plan.periods))
        shares = (vehicle.drive_shares, vehicle.brake_shares)
        self.wheel_torques = _of_wheels(given, "drive_torque", "wheel_torque", shares[0])
        self.brake_torques = _of_wheels(given, "brake", "brake_torque", shares[1])
        radius = float(np.mean(vehicle.per_wheel("tire_radius")))
        limit = vehicle.mass * GRAVITY * radius / WHEEL_COUNT
        self.controller = SpeedController(vehicle, limit, limit)


def _of_wheels(given: dict, total: str, each: str, shares: np.ndarray) -> np.ndarray:
    """Torques of the wheels (N m), shape (n, 4), from their total or from those of each."""
    count = len(given[SPEED])
    singles = [f"{each}_{wheel}" for wheel in WHEELS if f"{each}_{wheel}" in given]
    if total in given:
        if singles:
            problem = f"{total} together with {singles[0]}"
            raise InputError(f"columns: {total}", "", "a total, or values of wheels", problem)
        return np.outer(given[total], shares)
    still = np.zeros(count)
    return np.column_stack([given.get(f"{each}_{wheel}", still) for wheel in WHEELS])
