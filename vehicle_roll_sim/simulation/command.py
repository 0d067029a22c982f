"""What drives the vehicle: a command that is held, or varies with time, or answers the state."""

import abc
import dataclasses
import functools
import math
import numbers
from collections.abc import Callable, Sequence

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.records import COMMAND, LR, WHEELS

NO_FORCE = (0.0,) * len(WHEELS)


@dataclasses.dataclass(frozen=True)
class Command:
    """One set of commands, wheels in the order lf, rf, lr, rr.

    steering, rear_steering: road-wheel angle of both wheels of an axle (rad, left positive).
    wheel_torque: external torque at each wheel (N m, signed). brake_torque: the most that the brake
    of each wheel can oppose to its spin (N m, not below 0). normal_force: active force at each
    suspension corner (N, positive pushes the body up). speed_hold_gain, speed_hold_target: at each
    rear wheel a further torque gain * (target - u), in N m per m/s and m/s. Raises InputError for a
    value that is not finite.
    """

    steering: float = 0.0
    rear_steering: float = 0.0
    wheel_torque: tuple[float, float, float, float] = NO_FORCE
    brake_torque: tuple[float, float, float, float] = NO_FORCE
    normal_force: tuple[float, float, float, float] = NO_FORCE
    speed_hold_gain: float = 0.0
    speed_hold_target: float = 0.0

    def __post_init__(self):
        for name, value in vars(self).items():
            if not all(map(math.isfinite, _numbers(value))):
                raise InputError(name, value, "finite numbers")
        if min(self.brake_torque) < 0.0:
            raise InputError("brake_torque", self.brake_torque, "numbers that are not below 0")

    def records(self) -> np.ndarray:
        """The command as the equations take it: a COMMAND record in an array, not to be changed."""
        return self._records

    @functools.cached_property
    def _records(self) -> np.ndarray:
        record = np.zeros(1, COMMAND)
        for name in COMMAND.names:
            record[name] = getattr(self, name)
        return record


def _numbers(value) -> Sequence[float]:
    return (value,) if isinstance(value, numbers.Real) else value


Programme = Callable[[np.ndarray], np.ndarray]
"""Commands as a function of time: takes n times (s) and gives n COMMAND records."""


class Feedback(abc.ABC):
    """Commands that depend on the state: asked for at the beginning of each period, then held.

    One object drives one run, from its beginning.
    """

    @abc.abstractmethod
    def command(self, time: float, state) -> np.ndarray:
        """The COMMAND record, in an array, for the period that begins at `time` (s).

        state: gives the scalar states by name, `state["roll_rate"]`, as a STATE record does.
        """


def command_at(driver: Programme | Feedback, time: float, state) -> np.ndarray:
    """The COMMAND record, in an array, with which `driver` answers a state at `time` (s)."""
    if isinstance(driver, Feedback):
        return driver.command(time, state)
    return driver(np.array([time]))


def held_command(driver: Programme | Feedback, time: float, state) -> np.ndarray:
    """The COMMAND record, in an array, for a whole period that begins at `time` (s) in `state`.

    The torque that holds the speed is that of the beginning, as a command of wheel torques.
    """
    command = command_at(driver, time, state).copy()
    gain = command["speed_hold_gain"]
    if gain.any():
        missing = command["speed_hold_target"] - state["u"]
        command["wheel_torque"][:, LR:] += (gain * missing)[:, np.newaxis]
        command["speed_hold_gain"] = 0.0
    return command
