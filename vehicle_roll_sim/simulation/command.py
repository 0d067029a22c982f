"""Commands to the vehicle: constant, a function of time, or feedback of the state."""

import abc
import dataclasses
import functools
import math
from collections.abc import Callable, Sequence

import numpy as np

from vehicle_roll_sim.declaration import InputError, number_of
from vehicle_roll_sim.model.records import COMMAND, LR, WHEELS
from vehicle_roll_sim.roads.commanded import NOT_COMMANDED
from vehicle_roll_sim.simulation.memory import Remembering
from vehicle_roll_sim.vehicle.air_parameters import NO_WIND
from vehicle_roll_sim.vehicle.plausibility import LARGEST_STEERING, doubtful_steering, warn

NO_FORCE = (0.0,) * len(WHEELS)
STILL_AIR = (0.0, 0.0)
OWN_FRICTION = (1.0,) * len(WHEELS)


@dataclasses.dataclass(frozen=True)
class Command:
    """One set of commands, wheels in the order lf, rf, lr, rr.

    steering, rear_steering: road-wheel angle of both wheels of an axle (rad, left positive).
    wheel_torque: drive torque at each wheel (N m, signed). brake_torque: brake torque capacity at
    each wheel (N m, >= 0); it opposes the spin and can hold a stationary wheel. normal_force:
    active force at each suspension corner (N, positive pushes the body up). speed_hold_gain,
    speed_hold_target: additional torque at each rear wheel, gain * (target - u), in N m per m/s and
    m/s. wind: velocity of the air over the ground along x and y of the ground frame (m/s), for
    vehicles with air forces; x is the initial heading, y points to its left. road_height,
    road_friction: height of the road under each wheel (m), and factor of the friction of its tire
    (>= 0), for roads with the feature `commanded`.

    Values per wheel may be any sequence of four numbers, the wind one of two; all values are stored
    as floats. Raises InputError for non-finite values and for sequences of another length. Issues a
    PlausibilityWarning for implausibly large steering angles.
    """

    steering: float = 0.0
    rear_steering: float = 0.0
    wheel_torque: tuple[float, float, float, float] = NO_FORCE
    brake_torque: tuple[float, float, float, float] = NO_FORCE
    normal_force: tuple[float, float, float, float] = NO_FORCE
    speed_hold_gain: float = 0.0
    speed_hold_target: float = 0.0
    wind: tuple[float, float] = STILL_AIR
    road_height: tuple[float, float, float, float] = NO_FORCE
    road_friction: tuple[float, float, float, float] = OWN_FRICTION

    def __post_init__(self):
        for name, checked in KEPT.items():
            value = getattr(self, name)
            if (kept := checked(name, value)) is not value:
                object.__setattr__(self, name, kept)
        if min(self.brake_torque) < 0.0:
            raise InputError("brake_torque", self.brake_torque, "numbers of at least 0")
        if min(self.road_friction) < 0.0:
            raise InputError("road_friction", self.road_friction, "numbers of at least 0")
        for name in ("steering", "rear_steering"):
            if abs(angle := getattr(self, name)) > LARGEST_STEERING:
                rounded = float(f"{angle:.2g}")  # so that many commands give few distinct warnings
                warn([doubtful_steering(f"{name} of a command", rounded)])

    @property
    def road_friction_change(self) -> tuple[float, ...]:
        """The factors of friction less 1, as a COMMAND record has them."""
        return tuple(factor - 1.0 for factor in self.road_friction)

    def records(self) -> np.ndarray:
        """The command as input to the equations: an array of one COMMAND record; do not modify."""
        return self._records

    @functools.cached_property
    def _records(self) -> np.ndarray:
        record = np.zeros(1, COMMAND)
        for name in COMMAND.names:
            record[name] = getattr(self, name)
        return record

    @functools.cached_property
    def moves_road(self) -> bool:
        """Whether it has a height of the road under a wheel or a friction of its own."""
        return self.road_height != NO_FORCE or self.road_friction != OWN_FRICTION


def _number(field: str, value) -> float:
    number = number_of(value, field, "a finite number")
    if not math.isfinite(number):
        raise InputError(field, value, "a finite number")
    return number


def _of_wheels(field: str, value) -> tuple[float, ...]:
    if value is NO_FORCE or value is OWN_FRICTION:
        return value
    return _numbers(field, value, len(WHEELS), "four numbers, for lf, rf, lr and rr")


def _horizontal(field: str, value) -> tuple[float, ...]:
    if value is STILL_AIR:
        return value
    return _numbers(field, value, len(STILL_AIR), "two numbers, along x and y")


def _numbers(field: str, value, count: int, allowed: str) -> tuple[float, ...]:
    if _are_floats(value, count):
        return value
    is_text = isinstance(value, str | bytes)
    is_sequence = (isinstance(value, Sequence) and not is_text) or getattr(value, "ndim", None) == 1
    if not is_sequence or len(value) != count:
        raise InputError(field, value, allowed)
    return tuple([_number(field, each) for each in value])


def _are_floats(value, count: int) -> bool:
    """Whether this is what `_numbers` returns, as in most of the commands of a run.

    A sum is finite only if all of its terms are; one that overflows says nothing.
    """
    is_tuple = type(value) is tuple and len(value) == count
    return is_tuple and {*map(type, value)} == {float} and math.isfinite(sum(value))


_CHECKS = {NO_FORCE: _of_wheels, OWN_FRICTION: _of_wheels, STILL_AIR: _horizontal}
OF_ROAD = {"road_height": 0.0, "road_friction_change": 1.0}
"""Fields of COMMAND for roads that take them, and what is added to show them."""
KEPT = {field.name: _CHECKS.get(field.default, _number) for field in dataclasses.fields(Command)}
"""The function that checks each value of a command and converts it."""


IDLE = Command()
"""No command."""
Programme = Callable[[np.ndarray], np.ndarray]
"""Commands as a function of time: takes an array of n times (s), returns n COMMAND records.

A programme whose commands step may have an attribute `steps_at`: the times of the steps (s,
increasing). A run ends an integration step at each of them. The programme is first called with
times up to the step, for which the last record must be that before the step, and then with times
from the step on.
"""


def records_of(
    command: "Command | Programme",
    times: Callable[[], np.ndarray],
    feels_wind: bool = True,
    takes_road: bool = True,
) -> np.ndarray:
    """The COMMAND records at some times (s): one that is held, or one for each time.

    Raises InputError for anything that is not a command, for a wind unless the vehicle
    `feels_wind`, and for heights and frictions unless its road `takes_road`. Non-finite values are
    accepted, and the run then ends as diverged, except for brake torques, which would otherwise be
    ignored silently.
    """
    moves_road = True  # perhaps; what a Command knows takes far less time than a look at records
    if isinstance(command, Command):
        records, moves_road = command.records(), command.moves_road
    elif callable(command):
        instants = times()
        records = _checked(command(instants), len(instants))
    else:
        raise InputError("command", command, "a Command, or a function of an array of times")
    if not feels_wind and records["wind"].any():
        raise InputError("wind", float(max(records["wind"].flat, key=abs)), NO_WIND)
    if moves_road and not takes_road:
        for name, neutral in OF_ROAD.items():
            if (values := records[name]).any():
                value = round(neutral + float(max(values.flat, key=abs)), 12)
                raise InputError(name.removesuffix("_change"), value, NOT_COMMANDED)
    return records


def _checked(records, count: int) -> np.ndarray:
    """Return the records if they are valid commands for `count` times; raises InputError."""
    dtype, size = getattr(records, "dtype", None), np.size(records)
    if dtype != COMMAND or np.ndim(records) != 1 or size not in (1, count):
        allowed = f"one COMMAND record, or one for each of the {count} times"
        problem = f"the function returned {type(records).__name__} of size {size}, dtype {dtype}"
        raise InputError("command", "", allowed, problem)
    brakes = records["brake_torque"]
    if not ((brakes >= 0.0) & (brakes < math.inf)).all():
        lowest = float(np.min(brakes))
        raise InputError("brake_torque", lowest, "finite numbers of at least 0")
    return records


class Feedback(Remembering, abc.ABC):
    """Commands that depend on the state: computed at the beginning of each period, then held.

    Use a new object for each run. `memory` and `remember` save and restore its attributes.
    """

    @abc.abstractmethod
    def command(self, time: float, state) -> np.ndarray | Command:
        """The command for the period that begins at `time` (s).

        Returns a Command, or an array of one COMMAND record. state: a mapping of scalar states by
        name, such as `state["roll_rate"]` (SI units); a STATE record is one.
        """


def command_at(driver: Programme | Feedback, time: float, state) -> Command:
    """The command of `driver` for a state at `time` (s), to be held as a node would hold it.

    The speed hold is replaced by its torque at the present speed. Raises InputError if the driver
    returns anything that is not a command.
    """
    if isinstance(driver, Feedback):
        answer = driver.command(time, state)
        records = answer.records() if isinstance(answer, Command) else _checked(answer, 1)
    else:
        records = records_of(driver, lambda: np.array([time]))
    return held_command(records[0], state["u"])


def held_command(record: np.record, speed: float) -> Command:
    """The command in a COMMAND record, its speed hold replaced by the torque at a speed (m/s)."""
    steering, rear_steering, torque, brakes, forces, gain, target, wind, *road = record.tolist()
    heights, changes = road
    torque = torque.copy()
    torque[LR:] += gain * (target - float(speed))
    wheels = (tuple(each.tolist()) for each in (torque, brakes, forces))
    return Command(
        steering,
        rear_steering,
        *wheels,
        wind=tuple(wind.tolist()),
        road_height=tuple(heights.tolist()),
        road_friction=tuple((1.0 + changes).tolist()),
    )
