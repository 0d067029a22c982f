"""Commands to the vehicle: constant, a function of time, or feedback of the state."""

import abc
import dataclasses
import math
import operator
import struct
from collections.abc import Callable, Sequence

import numpy as np

from vehicle_roll_sim.declaration import InputError, number_of
from vehicle_roll_sim.model.layout import place_in
from vehicle_roll_sim.model.records import COMMAND, WHEELS
from vehicle_roll_sim.roads.commanded import NOT_COMMANDED
from vehicle_roll_sim.simulation.memory import Remembering
from vehicle_roll_sim.vehicle.air_parameters import NO_WIND
from vehicle_roll_sim.vehicle.plausibility import LARGEST_STEERING, doubtful_steering, warn

NO_FORCE = (0.0,) * len(WHEELS)
STILL_AIR = (0.0, 0.0)
OWN_FRICTION = (1.0,) * len(WHEELS)


_NUMBERS = struct.Struct(f"{COMMAND.itemsize // 8}d")
_of = operator.itemgetter(*(place_in(COMMAND, name) for name in COMMAND.names))
"""The numbers of a COMMAND record, and its fields from these: numpy takes ten times as long."""


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
        values = vars(self)
        for name, (neutral, checked) in KEPT.items():
            value = values[name]
            if value is not neutral and (kept := checked(name, value)) is not value:
                values[name] = kept
        self._check_ranges()

    def _check_ranges(self) -> None:
        """Raise InputError for brake torques and friction below 0, warn of large angles."""
        if self.brake_torque is not NO_FORCE and min(self.brake_torque) < 0.0:
            raise InputError("brake_torque", self.brake_torque, "numbers of at least 0")
        if self.road_friction is not OWN_FRICTION and min(self.road_friction) < 0.0:
            raise InputError("road_friction", self.road_friction, "numbers of at least 0")
        for name, angle in (("steering", self.steering), ("rear_steering", self.rear_steering)):
            if abs(angle) > LARGEST_STEERING:
                rounded = float(f"{angle:.2g}")  # so that many commands give few distinct warnings
                warn([doubtful_steering(f"{name} of a command", rounded)])

    @property
    def road_friction_change(self) -> tuple[float, ...]:
        """The factors of friction less 1, as a COMMAND record has them."""
        if self.road_friction is OWN_FRICTION:
            return NO_FORCE
        return tuple([factor - 1.0 for factor in self.road_friction])

    def records(self) -> np.ndarray:
        """The command as input to the equations: an array of one COMMAND record; do not modify."""
        if (records := vars(self).get("_records")) is None:
            records = vars(self)["_records"] = np.empty(1, COMMAND)
            wheels = (*self.wheel_torque, *self.brake_torque, *self.normal_force)
            hold = (self.speed_hold_gain, self.speed_hold_target)
            others = (*self.wind, *self.road_height, *self.road_friction_change)
            _NUMBERS.pack_into(
                records, 0, self.steering, self.rear_steering, *wheels, *hold, *others
            )
        return records

    @property
    def moves_road(self) -> bool:
        """Whether it has a height of the road under a wheel or a friction of its own."""
        return self.road_height != NO_FORCE or self.road_friction != OWN_FRICTION

    def replaced(self, **values) -> "Command":
        """The command with other values of some fields; `dataclasses.replace` takes far longer."""
        return type(self)(**{name: getattr(self, name) for name in KEPT} | values)


def _number(field: str, value) -> float:
    if type(value) is float and math.isfinite(value):  # as in most of the commands of a run
        return value
    number = number_of(value, field, "a finite number")
    if not math.isfinite(number):
        raise InputError(field, value, "a finite number")
    return number


def _of_wheels(field: str, value) -> tuple[float, ...]:
    if type(value) is tuple and len(value) == len(WHEELS):
        a, b, c, d = value
        is_of_floats = type(a) is type(b) is type(c) is type(d) is float
        if is_of_floats and math.isfinite(a + b + c + d):  # if it overflows, they are looked at
            return value
    return _numbers(field, value, len(WHEELS), "four numbers, for lf, rf, lr and rr")


def _horizontal(field: str, value) -> tuple[float, ...]:
    return _numbers(field, value, len(STILL_AIR), "two numbers, along x and y")


def _numbers(field: str, value, count: int, allowed: str) -> tuple[float, ...]:
    is_text = isinstance(value, str | bytes)
    is_sequence = (isinstance(value, Sequence) and not is_text) or getattr(value, "ndim", None) == 1
    if not is_sequence or len(value) != count:
        raise InputError(field, value, allowed)
    return tuple([_number(field, each) for each in value])


_CHECKS = {NO_FORCE: _of_wheels, OWN_FRICTION: _of_wheels, STILL_AIR: _horizontal}
OF_ROAD = {"road_height": 0.0, "road_friction_change": 1.0}
"""Fields of COMMAND for roads that take them, and what is added to show them."""
KEPT = {
    field.name: (field.default, _CHECKS.get(field.default, _number))
    for field in dataclasses.fields(Command)
}
"""The neutral value of each field of a command, and the function that checks any other value and
converts it."""


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
    dtype = getattr(records, "dtype", None)
    if dtype != COMMAND or records.ndim != 1 or records.size not in (1, count):
        allowed = f"one COMMAND record, or one for each of the {count} times"
        size = np.size(records)
        problem = f"the function returned {type(records).__name__} of size {size}, dtype {dtype}"
        raise InputError("command", "", allowed, problem)
    brakes = records["brake_torque"]
    if not (brakes.min(initial=0.0) >= 0.0 and brakes.max(initial=0.0) < math.inf):
        raise InputError("brake_torque", float(np.min(brakes)), "finite numbers of at least 0")
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
    numbers = _NUMBERS.unpack(record)
    steering, rear_steering, torque, *wheels, gain, target, wind, heights, changes = _of(numbers)
    hold = gain * (target - float(speed))
    lf, rf, lr, rr = torque
    torque = (lf, rf, lr + hold, rr + hold)
    factors = OWN_FRICTION if changes == NO_FORCE else tuple([1.0 + each for each in changes])
    values = (steering, rear_steering, torque, *wheels, 0.0, 0.0, wind, heights, factors)
    if not math.isfinite(sum(torque, sum(numbers))):
        return Command(*values)
    command = object.__new__(Command)
    vars(command).update(zip(KEPT, values, strict=True))
    command._check_ranges()  # all that is left to check
    return command
