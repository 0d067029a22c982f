"""The commands of the manoeuvres of several episodes, period by period."""

import math

import numpy as np

from vehicle_roll_sim.batch.fleet import Fleet
from vehicle_roll_sim.manoeuvres.base import Manoeuvre, OpenLoop
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.records import COMMAND, LR
from vehicle_roll_sim.simulation.command import Feedback, command_at
from vehicle_roll_sim.simulation.timetable import DEGREES, Timetable


class Drivers:
    """The drivers at the places of a fleet, with the commands that a node would hold.

    Commands that are a function of time, or of a fishhook, are computed once for the whole episode.
    Any other driver that responds to the state is asked in every period.
    """

    def __init__(self, count: int, period_ns: int):
        self._period_ns = period_ns
        self._drivers: list[Feedback | OpenLoop | None] = [None] * count
        self._tables = np.zeros((count, 1), COMMAND)
        self._is_asked = np.zeros(count, bool)
        self._side, self._level, self._since = np.zeros((3, count))
        self._has_risen = np.zeros(count, bool)

    def begin(self, i: int, manoeuvre: Manoeuvre, periods: int) -> None:
        """Begin a manoeuvre of some periods at a place."""
        driver = self._drivers[i] = manoeuvre.driver()
        self._side[i], self._has_risen[i] = 0.0, False
        self._is_asked[i] = not isinstance(driver, OpenLoop | Timetable)
        if self._is_asked[i]:
            return
        if periods > self._tables.shape[1]:
            missing = periods - self._tables.shape[1]
            self._tables = np.pad(self._tables, ((0, 0), (0, missing)))
        if isinstance(driver, Timetable):
            self._side[i] = driver.side * DEGREES
            self._level[i], self._since[i] = driver.level, driver.since
        self._fill(i)

    def _fill(self, i: int) -> None:
        driver = self._drivers[i]
        times = np.arange(self._tables.shape[1]) * self._period_ns / NANOSECONDS
        self._tables[i] = driver(times) if isinstance(driver, OpenLoop) else driver.commands(times)

    def commands(self, fleet: Fleet, going: np.ndarray) -> np.ndarray:
        """The commands of the periods that begin now, shape (n,), at the places that are `going`.

        The speed hold is replaced by its torque at the present speed.
        """
        self._watch(fleet, going)
        numbers = fleet.times_ns // self._period_ns
        at = np.minimum(numbers, self._tables.shape[1] - 1)
        commands = self._tables[np.arange(len(fleet)), at]
        torque = commands["speed_hold_gain"] * (commands["speed_hold_target"] - fleet.states["u"])
        commands["wheel_torque"][:, LR:] += torque[:, np.newaxis]
        commands["speed_hold_gain"] = commands["speed_hold_target"] = 0.0
        for i in np.flatnonzero(self._is_asked & going):
            time = float(fleet.times[i])
            commands[i] = command_at(self._drivers[i], time, fleet.states[i]).records()[0]
        return commands

    def _watch(self, fleet: Fleet, going: np.ndarray) -> None:
        """Note the reversals of the drivers that watch the roll rate."""
        watched = going & (self._side != 0.0)
        if not watched.any():
            return
        rates = fleet.states["roll_rate"]
        is_above = rates * self._side > self._level
        self._has_risen |= watched & is_above
        dropped = watched & self._has_risen & ~is_above & (fleet.times >= self._since)
        for i in np.flatnonzero(dropped):
            self._drivers[i].reverse(float(fleet.times[i]), float(rates[i]))
            self._side[i] = 0.0
            self._fill(i)


def periods_of(duration: float, period_ns: int) -> int:
    """The number of periods that begin within a duration (s)."""
    return math.ceil(round(duration * NANOSECONDS) / period_ns)
