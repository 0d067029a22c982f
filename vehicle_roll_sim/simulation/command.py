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
from vehicle_roll_sim.vehicle.plausibility import LARGEST_STEERING, doubtful_steering, warn

NO_FORCE = (0.0,) * len(WHEELS)


@dataclasses.dataclass(frozen=True)
class Command:
    """One set of commands, wheels in the order lf, rf, lr, rr.

    steering, rear_steering: road-wheel angle of both wheels of an axle (rad, left positive).
    wheel_torque: external torque at each wheel (N m, signed). brake_torque: the most that the brake
    of each wheel can oppose to its spin (N m, not below 0). normal_force: active force at each
    suspension corner (N, positive pushes the body up). speed_hold_gain, speed_hold_target: at each
    rear wheel a further torque gain * (target - u), in N m per m/s and m/s. Raises InputError for a
    value that is not finite, and warns (PlausibilityWarning) of steering beyond what wheels do.
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
        for name in ("steering", "rear_steering"):
            if abs(angle := getattr(self, name)) > LARGEST_STEERING:
                rounded = float(f"{angle:.2g}")  # few different lines for many commands
                warn([doubtful_steering(f"{name} of a command", rounded)])

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
"""Commands as a function of time: takes n times (s) and gives n COMMAND records.

Where its commands step it may have an attribute `steps_at`, the times (s, rising). A run ends an
integration step there: the programme is asked for times up to that one, whose last record is to be
the one before the step, and then for times from it on.
"""


class Feedback(abc.ABC):
    """Commands that depend on the state: asked for at the beginning of each period, then held.

    One object drives one run, from its beginning.
    """

    @abc.abstractmethod
    def command(self, time: float, state) -> np.ndarray:
        """The COMMAND record, in an array, for the period that begins at `time` (s).

        state: gives the scalar states by name, `state["roll_rate"]`, as a STATE record does.
        """


def command_at(driver: Programme | Feedback, time: float, state) -> Command:
    """What `driver` answers to a state at `time` (s), to be held: as a node would be told it.

    The speed hold becomes the torque that it gives at that speed.
    """
    is_feedback = isinstance(driver, Feedback)
    records = driver.command(time, state) if is_feedback else driver(np.array([time]))
    answer = records[0]
    hold = answer["speed_hold_gain"] * (answer["speed_hold_target"] - state["u"])
    torque = answer["wheel_torque"].copy()
    torque[LR:] += hold
    return Command(
        float(answer["steering"]),
        float(answer["rear_steering"]),
        tuple(torque.tolist()),
        *(tuple(answer[name].tolist()) for name in ("brake_torque", "normal_force")),
    )
