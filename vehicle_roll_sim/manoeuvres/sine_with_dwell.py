"""Sine with dwell (FMVSS 126): steering input and pass criteria."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.base import ADAPTED, LONGEST
from vehicle_roll_sim.manoeuvres.criteria import value_at
from vehicle_roll_sim.manoeuvres.handwheel import HandwheelProgramme
from vehicle_roll_sim.manoeuvres.scaled import ScaledManoeuvre
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

DWELL_AT = 0.75
"""Fraction of the sine's period before the dwell: up to its second peak."""
YAW_RATE_LIMITS = {1.0: 0.35, 1.75: 0.20}
"""Time after completion of steer (s): maximum ratio of the yaw rate to its peak."""
DISPLACEMENT_AFTER, LEAST_DISPLACEMENT, LEAST_OF_HEAVY = 1.07, 1.83, 1.52
"""Time after the beginning of steer (s), and the minimum lateral displacement (m) at that time, in
general and of a vehicle above HEAVY."""
HEAVY = 3500.0
"""kg, of the whole vehicle."""
DISPLACEMENT_FROM = 5.0
"""Smallest `scalar` at which that lateral displacement is required."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class SineWithDwell(ScaledManoeuvre, HandwheelProgramme):
    """One period of a sine at the handwheel, with a dwell at its second peak."""

    frequency: float = parameter("frequency of the sine", "Hz", 1e-3, 100.0, default=0.7)
    dwell: float = parameter("dwell time at the second peak", "s", 0.0, LONGEST, default=0.5)
    least_displacement: float = LEAST_DISPLACEMENT
    """m; `for_vehicle` sets it."""

    def filled_in(self, vehicle: Vehicle, options: Options) -> "SineWithDwell":
        least = LEAST_OF_HEAVY if vehicle.mass > HEAVY else LEAST_DISPLACEMENT
        return dataclasses.replace(super().filled_in(vehicle, options), least_displacement=least)

    @property
    def end(self) -> float:
        """Time of completion of steer (s)."""
        return self.start + 1.0 / self.frequency + self.dwell

    def handwheel(self, times: np.ndarray) -> np.ndarray:
        dwell_from = self.start + DWELL_AT / self.frequency
        held_back = np.clip(times - dwell_from, 0.0, self.dwell)
        sine_time = np.clip(times - self.start - held_back, 0.0, 1.0 / self.frequency)
        return self.amplitude * np.sin(2.0 * math.pi * self.frequency * sine_time)

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        result = self.result(history)
        limits = zip(result.yaw_rate_ratios, YAW_RATE_LIMITS.items(), strict=True)
        ratios = {}
        for ratio, (after, limit) in limits:
            text = _text(100.0 * ratio, "% of its peak")
            ratios[f"yaw rate after {after:.2f} s"] = f"{text} (at most {100.0 * limit:g} %)"
        wanted = (
            f"at least {self.least_displacement:g} m if scalar is {DISPLACEMENT_FROM:g} or more"
        )
        return {
            **super().report(history, driver),
            **ratios,
            "lateral displacement": f"{_text(result.displacement, 'm')} ({wanted})",
            "verdict": "passed" if result.is_passed else "failed",
        }

    def result(self, history: History) -> "SineWithDwellResult":
        """The criteria evaluated from a run; values at times that it did not reach are nan."""
        side = math.copysign(1.0, self.amplitude)
        peak = self._second_peak(history["time"], -side * history["yaw_rate"])
        ratios = [
            abs(value_at(history, "yaw_rate", self.end + after)) / peak for after in YAW_RATE_LIMITS
        ]
        moved = side * value_at(history, "y", self.start + DISPLACEMENT_AFTER)
        return SineWithDwellResult(self.scalar, tuple(ratios), moved, self.least_displacement)

    def _second_peak(self, time: np.ndarray, yaw_rate: np.ndarray) -> float:
        """Peak yaw rate (rad/s) in the second direction of steer, until completion of steer.

        yaw_rate: positive in that direction (rad/s). nan if it is never positive.
        """
        reversal = self.start + 0.5 / self.frequency
        there = yaw_rate[(time >= reversal) & (time <= self.end)]
        return float(there.max()) if np.any(there > 0.0) else math.nan


@dataclasses.dataclass(frozen=True)
class SineWithDwellResult:
    """Results of one run.

    scalar: handwheel amplitude over the angle at 0.3 g. yaw_rate_ratios: magnitude of the yaw rate
    1.00 and 1.75 s after completion of steer, over its peak between the sign change of the
    handwheel angle and completion of steer. displacement: lateral displacement towards the side
    of the first turn (m). least_displacement: the smallest allowed one (m).
    """

    scalar: float
    yaw_rate_ratios: tuple[float, ...]
    displacement: float
    least_displacement: float = LEAST_DISPLACEMENT

    @property
    def is_passed(self) -> bool:
        limits = zip(self.yaw_rate_ratios, YAW_RATE_LIMITS.values(), strict=True)
        is_stable = all(ratio <= limit for ratio, limit in limits)
        is_judged = abs(self.scalar) >= DISPLACEMENT_FROM
        return is_stable and (not is_judged or self.displacement >= self.least_displacement)


def _text(value: float, unit: str) -> str:
    return "unknown" if math.isnan(value) else f"{value:.3f} {unit}"


LADDER_TO = 6.5
"""Largest `scalar` of the standard's series, unless 270 deg need a larger one."""
SINE_WITH_DWELL = SineWithDwell(
    speed=80 / 3.6, scalar=5.0, largest_of_standard=LADDER_TO, duration=6.0, speed_hold=ADAPTED
)
"""80 km/h, then coasting; the smallest amplitude of the series at which all criteria apply."""
