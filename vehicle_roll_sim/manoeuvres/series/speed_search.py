"""Search for the entry speeds at which wheels lift off and the vehicle rolls over."""

import dataclasses
import functools
import math
from collections.abc import Callable, Iterator

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter, parameters_of
from vehicle_roll_sim.manoeuvres.base import SIDES, Manoeuvre
from vehicle_roll_sim.manoeuvres.criteria import has_wheel_heights, two_wheel_lift
from vehicle_roll_sim.manoeuvres.series.base import Series, driven, ending_of
from vehicle_roll_sim.model.integration.events import VALUE, Condition
from vehicle_roll_sim.simulation.limits import MAXIMUM_SPEED
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

KMH = 3.6
"""km/h per m/s."""
SIGNED = ("amplitude", "scalar", "handwheel_angle", "lateral_acceleration", "wind_speed")
"""Manoeuvre parameters whose sign determines the direction of the first input."""
UNKNOWN = "unknown"
DIVERGED = Condition.DIVERGED.name.lower()
SPEED, END = 1, -1
"""Indices in a row that begins with the direction."""
EVENTS = {"wheel lift-off": 3, "two-wheel lift": 4, "rollover": 5}
"""The events searched for, by increasing severity.

Values are the indices of their times (s, nan if there is none) in a row without the direction.
"""
ROUNDING = 1e-9
"""m/s"""


@dataclasses.dataclass(frozen=True)
class SpeedSearch(Series):
    """Runs at rising entry speeds up to the first rollover, then a bisection for each event.

    The bisection narrows the interval between the lowest speed driven at which the event occurs and
    the next lower one. It finds the first occurrence from the lowest speed upwards; that an event
    no longer occurs at some higher speed goes unnoticed.
    """

    lowest_speed: float = parameter("lowest entry speed", "m/s", 0.1, MAXIMUM_SPEED, default=5.0)
    highest_speed: float = parameter("highest entry speed", "m/s", 0.1, MAXIMUM_SPEED, default=40.0)
    speed_step: float = parameter(
        "entry-speed step up to the first rollover", "m/s", 0.01, MAXIMUM_SPEED, default=2.5
    )
    resolution: float = parameter(
        "width of the speed interval at which the bisection stops", "m/s", 1e-3, 100.0, default=0.1
    )

    columns = (
        *("direction", "speed", "speed_kmh", "peak_roll_deg", "lift_off", "two_wheel_lift"),
        *("rollover", "end"),
    )
    fixed = ("speed",)
    """Parameters of the manoeuvre that the search sets itself."""

    @property
    def settings(self) -> tuple[tuple[str, object], ...]:
        return (("manoeuvre", self.manoeuvre), RANGE)

    def with_values(self, values: dict) -> "SpeedSearch":
        """A copy with some values of the search and of the manoeuvre replaced.

        Raises InputError for the manoeuvre's own entry speed, which the search sets.
        """
        for name in self.fixed:
            if name in values:
                raise InputError(name, values[name], "lowest_speed and highest_speed instead")
        own = {name: value for name, value in values.items() if name in parameters_of(type(self))}
        of_manoeuvre = {name: value for name, value in values.items() if name not in own}
        return dataclasses.replace(super().with_values(of_manoeuvre), **own)

    def __post_init__(self):
        if not self.lowest_speed < self.highest_speed:
            allowed = f"more than lowest_speed, {self.lowest_speed:g} m/s"
            raise InputError("highest_speed", self.highest_speed, allowed)

    @property
    def speeds(self) -> list[float]:
        """Entry speeds of the first pass (m/s); the last is always highest_speed."""
        below = np.arange(self.lowest_speed, self.highest_speed - ROUNDING, self.speed_step)
        return [*np.round(below, 9).tolist(), self.highest_speed]

    def rows_to_a_side(
        self, ready: Manoeuvre, direction: str, vehicle: Vehicle, options: Options
    ) -> Iterator[tuple]:
        ready = to_the(direction, ready)
        rows: dict[float, tuple] = {}
        for speed in self.speeds:
            rows[speed] = _row(ready, speed, vehicle, options)
            yield rows[speed]
            if not math.isnan(rows[speed][EVENTS["rollover"]]):
                break
        for event in EVENTS.values():
            while self._is_wide(gap := gap_of(rows, event)):
                speed = sum(gap) / 2
                rows[speed] = _row(ready, speed, vehicle, options)
                yield rows[speed]

    def _is_wide(self, gap: tuple[float, float]) -> bool:
        below, first = gap
        return self.resolution < first - below < math.inf

    def remarks(self, vehicle: Vehicle, rows: list[tuple]) -> dict[str, str]:
        """For each event, the speeds between which it first occurs; and the runs that diverged."""
        found = {
            f"first {label}": _to_sides(rows, functools.partial(_where, event=event))
            for label, event in EVENTS.items()
        }
        diverged = sorted({row[SPEED] for row in rows if row[END] == DIVERGED})
        if diverged:
            speeds = ", ".join(f"{speed:.3f}" for speed in diverged)
            found["diverged"] = f"at {speeds} m/s: the outcome at these speeds is unknown"
        return found

    def verdict(self, rows: list[tuple]) -> str:
        """The most severe event, and the lowest speed at which it occurred."""
        doubtful = any(row[END] == DIVERGED for row in rows)
        return _to_sides(rows, _worst) + (", disregarding runs that diverged" if doubtful else "")


RANGE = ("range of entry speeds", SpeedSearch)
"""Title and declaring class of the options of a search."""


def to_the(direction: str, manoeuvre: Manoeuvre) -> Manoeuvre:
    """The manoeuvre with its first input in that direction."""
    names = {field.name for field in dataclasses.fields(manoeuvre)}
    present = [name for name in SIGNED if name in names]
    values = {name: SIDES[direction] * abs(getattr(manoeuvre, name)) for name in present}
    return dataclasses.replace(manoeuvre, **values)


def _row(ready: Manoeuvre, speed: float, vehicle: Vehicle, options: Options) -> tuple:
    """Drive one run; returns its row without the direction."""
    manoeuvre = dataclasses.replace(ready, speed=speed).for_vehicle(vehicle, options)
    simulation, history = driven(manoeuvre, vehicle, options)
    events = simulation.events
    lift_offs = [time for time in events.lift_off_time.tolist() if not math.isnan(time)]
    knows_heights = has_wheel_heights(history)
    return (
        speed,
        speed * KMH,
        math.degrees(events.peak_roll[VALUE]),
        min(lift_offs, default=math.nan),
        two_wheel_lift(history) if knows_heights else UNKNOWN,
        float(events.rollover_time[0]),
        ending_of(simulation),
    )


def gap_of(rows: dict[float, tuple], event: int) -> tuple[float, float]:
    """The highest speed driven below the first occurrence of an event, and that of it (m/s).

    rows: by speed (m/s). The second is inf if the event never occurred; the first is -inf if it
    occurred at the lowest speed.
    """
    first = min((speed for speed, row in rows.items() if _happened(row[event])), default=math.inf)
    return max((speed for speed in rows if speed < first), default=-math.inf), first


def _happened(time: float | str) -> bool:
    return time != UNKNOWN and not math.isnan(time)


def _to_sides(rows: list[tuple], find: Callable[[dict[float, tuple]], str]) -> str:
    """Apply `find` to the rows of each side, by speed, and join the texts."""
    found = {}
    for side in SIDES:
        found[side] = find({row[SPEED]: row[1:] for row in rows if row[0] == side})
    if len(set(found.values())) == 1:
        return f"{found['left']}, to either side"
    return "; ".join(f"{text}, to the {side}" for side, text in found.items())


def _where(rows: dict[float, tuple], event: int) -> str:
    """The speeds between which an event first occurs, in words."""
    below, first = gap_of(rows, event)
    if any(row[event] == UNKNOWN for row in rows.values()):
        return "unknown: the model does not compute wheel heights"
    if math.isinf(first):
        return f"none up to {_speed(max(rows))}"
    if math.isinf(below):
        return f"already at {_speed(first)}, the lowest speed"
    return f"between {below:.3f} and {_speed(first)}"


def _worst(rows: dict[float, tuple]) -> str:
    for label, event in reversed(EVENTS.items()):
        _, first = gap_of(rows, event)
        if not math.isinf(first):
            return f"{label} at {_speed(first)}"
    return f"no wheel lift-off up to {_speed(max(rows))}"


def _speed(speed: float) -> str:
    return f"{speed:.3f} m/s ({speed * KMH:.1f} km/h)"
