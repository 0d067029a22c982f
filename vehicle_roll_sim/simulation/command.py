"""What drives the vehicle: a command that is held, or varies with time, or answers the state."""

import abc
import dataclasses
import functools
import math
from collections.abc import Callable, Sequence

import numpy as np

from vehicle_roll_sim.declaration import InputError, number_of
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
    rear wheel a further torque gain * (target - u), in N m per m/s and m/s. Wheels take any
    sequence of four numbers; all values are kept as floats. Raises InputError for a value that is
    not a finite number, and for more or fewer than four. Warns (PlausibilityWarning) of steering
    beyond what wheels do.
    """

    steering: float = 0.0
    rear_steering: float = 0.0
    wheel_torque: tuple[float, float, float, float] = NO_FORCE
    brake_torque: tuple[float, float, float, float] = NO_FORCE
    normal_force: tuple[float, float, float, float] = NO_FORCE
    speed_hold_gain: float = 0.0
    speed_hold_target: float = 0.0

    def __post_init__(self):
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            kept = _of_wheels if field.default is NO_FORCE else _number
            object.__setattr__(self, field.name, kept(field.name, value))
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


def _number(field: str, value) -> float:
    number = number_of(value, field, "a finite number")
    if not math.isfinite(number):
        raise InputError(field, value, "a finite number")
    return number


def _of_wheels(field: str, value) -> tuple[float, ...]:
    is_text = isinstance(value, str | bytes)
    is_sequence = (isinstance(value, Sequence) and not is_text) or getattr(value, "ndim", None) == 1
    if not is_sequence or len(value) != len(WHEELS):
        raise InputError(field, value, "four numbers, of lf, rf, lr and rr")
    return tuple(_number(field, each) for each in value)


Programme = Callable[[np.ndarray], np.ndarray]
"""Commands as a function of time: takes n times (s) and gives n COMMAND records.

Where its commands step it may have an attribute `steps_at`, the times (s, rising). A run ends an
integration step there: the programme is asked for times up to that one, whose last record is to be
the one before the step, and then for times from it on.
"""


def records_of(command: "Command | Programme", times: Callable[[], np.ndarray]) -> np.ndarray:
    """The COMMAND records for some times (s): one that is held, or one for each.

    Raises InputError for what is no command. A value that is not finite is none that a run could go
    on with: it ends as diverged; but a brake torque, which would count as none, is refused.
    """
    if isinstance(command, Command):
        return command.records()
    if not callable(command):
        raise InputError("command", command, "a Command, or a function of an array of times")
    wanted = times()
    return _checked(command(wanted), len(wanted))


def _checked(records, count: int) -> np.ndarray:
    """What a driver has answered for `count` times, if it is that."""
    dtype, size = getattr(records, "dtype", None), np.size(records)
    if dtype != COMMAND or np.ndim(records) != 1 or size not in (1, count):
        allowed = f"one COMMAND record, or one for each of the {count} times"
        problem = f"the function gave {type(records).__name__} of {size}, {dtype}"
        raise InputError("command", "", allowed, problem)
    brakes = records["brake_torque"]
    if not ((brakes >= 0.0) & (brakes < math.inf)).all():
        lowest = float(np.min(brakes))
        raise InputError("brake_torque", lowest, "finite numbers that are not below 0")
    return records


class Feedback(abc.ABC):
    """Commands that depend on the state: asked for at the beginning of each period, then held.

    One object drives one run, from its beginning.
    """

    @abc.abstractmethod
    def command(self, time: float, state) -> np.ndarray | Command:
        """A Command, or a COMMAND record in an array, for the period that begins at `time` (s).

        state: gives the scalar states by name, `state["roll_rate"]`, as a STATE record does.
        """


def command_at(driver: Programme | Feedback, time: float, state) -> Command:
    """What `driver` answers to a state at `time` (s), to be held: as a node would be told it.

    The speed hold becomes the torque that it gives at that speed. Raises InputError for an answer
    that is no command.
    """
    if isinstance(driver, Feedback):
        answer = driver.command(time, state)
        records = answer.records() if isinstance(answer, Command) else _checked(answer, 1)
    else:
        records = records_of(driver, lambda: np.array([time]))
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
