"""NHTSA's rollover manoeuvres: J-turn and fishhook with roll-rate feedback (1b)."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.base import ADAPTED, LONGEST
from vehicle_roll_sim.manoeuvres.criteria import two_wheel_lift_line
from vehicle_roll_sim.manoeuvres.handwheel import (
    METRES_PER_SECOND_OF_A_MPH,
    HandwheelProgramme,
    ramp,
)
from vehicle_roll_sim.manoeuvres.scaled import ScaledManoeuvre
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.timetable import Timetable


@dataclasses.dataclass(frozen=True, kw_only=True)
class RolloverManoeuvre(ScaledManoeuvre):
    """The handwheel is turned, held and returned to zero; the criterion is two-wheel lift."""

    handwheel_rate: float = parameter("rate of the handwheel angle", "deg/s", 1e-3, 1e5)
    hold: float = parameter("time for which the final angle is held", "s", 0.0, LONGEST)
    back: float = parameter(
        "time in which the handwheel is returned to zero", "s", 1e-3, LONGEST, default=2.0
    )

    def brought_back(self, times: np.ndarray, since: float) -> np.ndarray:
        """Factor on the final angle, falling from 1 to 0; the angle was reached at `since` (s)."""
        return 1.0 - np.clip((times - since - self.hold) / self.back, 0.0, 1.0)

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        return {**super().report(history, driver), **two_wheel_lift_line(history)}


@dataclasses.dataclass(frozen=True, kw_only=True)
class JTurn(RolloverManoeuvre, HandwheelProgramme):
    """One turn of the handwheel, held and then returned to zero."""

    def handwheel(self, times: np.ndarray) -> np.ndarray:
        turned = ramp(times, self.start, self.handwheel_rate, self.amplitude)
        arrived = self.start + abs(self.amplitude) / self.handwheel_rate
        return turned * self.brought_back(times, arrived)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Fishhook(RolloverManoeuvre):
    """A turn held until the roll rate has dropped, then the same angle to the other side."""

    reversal_roll_rate: float = parameter(
        "the handwheel is reversed when the roll rate, after rising above this value, drops to it",
        "deg/s",
        0.0,
        1e3,
    )

    def driver(self) -> "FishhookDriver":
        return FishhookDriver(self)

    @property
    def turned(self) -> float:
        """Time at which the first turn is complete (s)."""
        return self.start + abs(self.amplitude) / self.handwheel_rate

    def handwheel(self, times: np.ndarray, reversal: float) -> np.ndarray:
        """Handwheel angles (deg) at `times` (s), both (n,), with the reversal at `reversal` (s)."""
        first = ramp(times, self.start, self.handwheel_rate, self.amplitude)
        other_way = ramp(times, reversal, self.handwheel_rate, -2.0 * self.amplitude)
        arrived = reversal + 2.0 * abs(self.amplitude) / self.handwheel_rate
        return (first + other_way) * self.brought_back(times, arrived)

    def report(self, history: History, driver: "FishhookDriver") -> dict[str, str]:
        reversed_at = "none: the roll rate did not rise above the threshold and drop again"
        if driver.reversal < math.inf:
            reversed_at = f"{driver.reversal:.3f} s at a roll rate of {driver.roll_rate:.3f} deg/s"
        return {**super().report(history, driver), "steering reversal": reversed_at}


class FishhookDriver(Timetable):
    """Turns the handwheel of a fishhook, and reverses it depending on the roll rate.

    The reversal takes place when the roll rate towards the outside of the turn has dropped to the
    threshold, but not before the first turn is complete.
    """

    def __init__(self, manoeuvre: Fishhook):
        outside = math.copysign(1.0, manoeuvre.amplitude)
        super().__init__(outside, manoeuvre.reversal_roll_rate, manoeuvre.turned)
        self.manoeuvre = manoeuvre

    def commands(self, times: np.ndarray) -> np.ndarray:
        commands = self.manoeuvre.straight_ahead(times)
        handwheel = self.manoeuvre.handwheel(times, self.reversal)
        commands["steering"] = self.manoeuvre.road_wheel(handwheel)
        return commands


LOWEST_ENTRY = 35 * METRES_PER_SECOND_OF_A_MPH
"""m/s: the first entry speed of both series."""
NHTSA_J_TURN = JTurn(
    speed=LOWEST_ENTRY,
    scalar=8.0,
    largest_of_standard=8.0,
    handwheel_rate=1000.0,
    hold=4.0,
    duration=9.0,
    speed_hold=ADAPTED,
)
"""Handwheel to 8.0 times the angle at 0.3 g at 1000 deg/s, held for 4 s, returned in 2 s."""
NHTSA_FISHHOOK = Fishhook(
    speed=LOWEST_ENTRY,
    scalar=6.5,
    largest_of_standard=6.5,
    handwheel_rate=720.0,
    reversal_roll_rate=1.5,
    hold=3.0,
    duration=10.0,
    speed_hold=ADAPTED,
)
"""Handwheel to 6.5 times the angle at 0.3 g at 720 deg/s, reversed when the roll rate drops to
1.5 deg/s, held for 3 s, returned in 2 s."""
