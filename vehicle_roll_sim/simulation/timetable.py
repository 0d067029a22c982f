"""Drivers whose commands are a function of time, but for one reaction to the roll rate."""

import abc
import math

import numpy as np

from vehicle_roll_sim.simulation.command import Feedback

DEGREES = 180.0 / math.pi
"""deg per rad, as in math.degrees."""


class Timetable(Feedback):
    """Commands by time; they change once, when the roll rate has dropped.

    That is in the first command period that begins at `since` (s) or later and in which the roll
    rate, towards `side` (1.0 or -1.0), has been above `level` (deg/s) and no longer is. `reversal`:
    time at which it was (s), inf until then. `roll_rate`: the roll rate at that time (deg/s,
    towards the side).
    """

    def __init__(self, side: float, level: float, since: float):
        self.side, self.level, self.since = side, level, since
        self.reversal, self.roll_rate = math.inf, math.nan
        self.has_risen = False

    @abc.abstractmethod
    def commands(self, times: np.ndarray) -> np.ndarray:
        """COMMAND records (n,) at `times` (n,) (s), with the reversal if it has been."""

    def command(self, time: float, state) -> np.ndarray:
        if self.reversal == math.inf:
            self._watch(time, state["roll_rate"])
        return self.commands(np.array([time]))

    def towards_side(self, roll_rate: float) -> float:
        """A roll rate (rad/s) in deg/s, positive towards the side."""
        return math.degrees(roll_rate) * self.side

    def reverse(self, time: float, roll_rate: float) -> None:
        """Note that the roll rate (rad/s) has dropped at a time (s)."""
        self.reversal, self.roll_rate = time, self.towards_side(roll_rate)

    def _watch(self, time: float, roll_rate: float) -> None:
        is_above = self.towards_side(roll_rate) > self.level
        self.has_risen = self.has_risen or is_above
        if self.has_risen and not is_above and time >= self.since:
            self.reverse(time, roll_rate)
