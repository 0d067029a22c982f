"""Entry speeds of a manoeuvre at which wheels lift and the vehicle rolls over."""

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
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import MAXIMUM_SPEED
from vehicle_roll_sim.vehicle.parameters import Vehicle

KMH = 3.6
"""km/h in a m/s."""
SIGNED = ("amplitude", "scalar", "handwheel_angle", "lateral_acceleration")
"""Parameters of manoeuvres whose sign is the side that is steered to first."""
UNKNOWN = "unknown"
ROLLED_OVER = Condition.ROLLED_OVER.name.lower()
DIVERGED = Condition.DIVERGED.name.lower()
SPEED, END = 1, -1
"""Places in a row with its direction."""
EVENTS = {"wheel lift-off": 3, "two-wheel lift": 4, "rollover": 5}
"""What is searched for, from the least to the worst, and the place of its time (s, nan if there is
none) in a row without the direction."""
ROUNDING = 1e-9
"""m/s"""


@dataclasses.dataclass(frozen=True)
class SpeedSearch(Series):
    """Entry speeds in steps up to the first rollover, then a bisection for each event.

    It narrows the gap between the lowest speed with the event, of those driven, and the one below
    it. So what is found is the first change met from the lowest speed upwards; where a vehicle that
    lifts its wheels at one speed does not at a higher one, that is not seen.
    """

    lowest_speed: float = parameter("first entry speed", "m/s", 0.1, MAXIMUM_SPEED, default=5.0)
    highest_speed: float = parameter("last entry speed", "m/s", 0.1, MAXIMUM_SPEED, default=40.0)
    speed_step: float = parameter(
        "step of the entry speed up to the first rollover", "m/s", 0.01, MAXIMUM_SPEED, default=2.5
    )
    resolution: float = parameter(
        "bisect until an event is known to happen within this", "m/s", 1e-3, 100.0, default=0.1
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
        """A copy with other values of the range and of the manoeuvre but for its speed."""
        for name in self.fixed:
            if name in values:
                raise InputError(name, values[name], "lowest_speed and highest_speed in its place")
        own = {name: value for name, value in values.items() if name in parameters_of(type(self))}
        of_manoeuvre = {name: value for name, value in values.items() if name not in own}
        return dataclasses.replace(super().with_values(of_manoeuvre), **own)

    def __post_init__(self):
        if not self.lowest_speed < self.highest_speed:
            allowed = f"more than the lowest one, {self.lowest_speed:g} m/s"
            raise InputError("highest_speed", self.highest_speed, allowed)

    @property
    def speeds(self) -> list[float]:
        """Entry speeds of the first climb (m/s); the highest one is always the last."""
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
            if rows[speed][END] == ROLLED_OVER:
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
        """A line for each event: between which speeds it happens first. And the runs to doubt."""
        found = {
            f"first {label}": _to_sides(rows, functools.partial(_where, event=event))
            for label, event in EVENTS.items()
        }
        diverged = sorted({row[SPEED] for row in rows if row[END] == DIVERGED})
        if diverged:
            speeds = ", ".join(f"{speed:.3f}" for speed in diverged)
            found["diverged"] = f"at {speeds} m/s: what would have happened there is not known"
        return found

    def verdict(self, rows: list[tuple]) -> str:
        """The worst that happened, at the lowest speed that it was seen at."""
        doubtful = any(row[END] == DIVERGED for row in rows)
        return _to_sides(rows, _worst) + (", but for runs that diverged" if doubtful else "")


RANGE = ("range of entry speeds", SpeedSearch)
"""Title and declaring class of the options that ask for a search."""


def to_the(direction: str, manoeuvre: Manoeuvre) -> Manoeuvre:
    """The manoeuvre begun to that side."""
    names = {field.name for field in dataclasses.fields(manoeuvre)}
    present = [name for name in SIGNED if name in names]
    values = {name: SIDES[direction] * abs(getattr(manoeuvre, name)) for name in present}
    return dataclasses.replace(manoeuvre, **values)


def _row(ready: Manoeuvre, speed: float, vehicle: Vehicle, options: Options) -> tuple:
    """One run, without the direction in front."""
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
    """The lowest speed with that event, of those driven, and the highest one below it (m/s).

    inf where none had it; -inf where the lowest one had it already.
    """
    first = min((speed for speed, row in rows.items() if _happened(row[event])), default=math.inf)
    return max((speed for speed in rows if speed < first), default=-math.inf), first


def _happened(time: float | str) -> bool:
    return time != UNKNOWN and not math.isnan(time)


def _to_sides(rows: list[tuple], find: Callable[[dict[float, tuple]], str]) -> str:
    """What is found for the runs to either side, by their speed, in words."""
    found = {}
    for side in SIDES:
        found[side] = find({row[SPEED]: row[1:] for row in rows if row[0] == side})
    if len(set(found.values())) == 1:
        return f"{found['left']}, to either side"
    return "; ".join(f"{text}, to the {side}" for side, text in found.items())


def _where(rows: dict[float, tuple], event: int) -> str:
    """Between which speeds an event happens first."""
    below, first = gap_of(rows, event)
    if any(row[event] == UNKNOWN for row in rows.values()):
        return "unknown: the model has no wheel heights"
    if math.isinf(first):
        return f"none up to {_speed(max(rows))}"
    if math.isinf(below):
        return f"at {_speed(first)}, the lowest speed, already"
    return f"between {below:.3f} and {_speed(first)}"


def _worst(rows: dict[float, tuple]) -> str:
    for label, event in reversed(EVENTS.items()):
        _, first = gap_of(rows, event)
        if not math.isinf(first):
            return f"{label} at {_speed(first)}"
    return f"no wheel lifts up to {_speed(max(rows))}"


def _speed(speed: float) -> str:
    return f"{speed:.3f} m/s ({speed * KMH:.1f} km/h)"
