"""Sine with dwell (FMVSS 126): its steering, and what a vehicle must do to pass."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.base import LONGEST
from vehicle_roll_sim.manoeuvres.criteria import value_at
from vehicle_roll_sim.manoeuvres.handwheel import HOLD, HandwheelProgramme
from vehicle_roll_sim.manoeuvres.scaled import ScaledManoeuvre
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme

DWELL_AT = 0.75
"""Share of the sine that is steered before the dwell: to its second peak."""
YAW_RATE_LIMITS = {1.0: 0.35, 1.75: 0.20}
"""Time after the end of the steering (s): largest yaw rate over its peak."""
DISPLACEMENT_AFTER, LEAST_DISPLACEMENT = 1.07, 1.83
"""s after the beginning of the steering, and m to the side by then."""
DISPLACEMENT_FROM = 5.0
"""Smallest amplitude, over the angle at 0.3 g, of which that displacement is wanted."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class SineWithDwell(ScaledManoeuvre, HandwheelProgramme):
    """One sine of the handwheel that stays at its second peak for a while."""

    frequency: float = parameter("frequency of the sine", "Hz", 1e-3, 100.0, default=0.7)
    dwell: float = parameter("stay at the second peak", "s", 0.0, LONGEST, default=0.5)

    @property
    def end(self) -> float:
        """When the steering is complete (s)."""
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
            ratios[f"yaw rate after {after:.2f} s"] = f"{text} (at most {100.0 * limit:g})"
        wanted = f"at least {LEAST_DISPLACEMENT:g}, from {DISPLACEMENT_FROM:g} times on"
        return {
            **super().report(history, driver),
            **ratios,
            "lateral displacement": f"{_text(result.displacement, 'm')} ({wanted})",
            "verdict": "passed" if result.is_passed else "failed",
        }

    def result(self, history: History) -> "SineWithDwellResult":
        """The criteria of a run with this manoeuvre; what it did not get to is nan."""
        side = math.copysign(1.0, self.amplitude)
        peak = self._second_peak(history["time"], -side * history["yaw_rate"])
        ratios = [
            abs(value_at(history, "yaw_rate", self.end + after)) / peak for after in YAW_RATE_LIMITS
        ]
        moved = side * value_at(history, "y", self.start + DISPLACEMENT_AFTER)
        return SineWithDwellResult(self.scalar, tuple(ratios), moved)

    def _second_peak(self, time: np.ndarray, yaw_rate: np.ndarray) -> float:
        """Largest yaw rate (rad/s) to the second side while the handwheel is there; nan if none."""
        reversal = self.start + 0.5 / self.frequency
        there = yaw_rate[(time >= reversal) & (time <= self.end)]
        return float(there.max()) if np.any(there > 0.0) else math.nan


@dataclasses.dataclass(frozen=True)
class SineWithDwellResult:
    """Magnitudes of the yaw rate 1.00 and 1.75 s after the steering, over their peak, and the
    displacement (m) to the side that was steered to first.

    The peak is that from the handwheel's change of sign to the end of the steering. scalar: the
    amplitude over the angle at 0.3 g.
    """

    scalar: float
    yaw_rate_ratios: tuple[float, ...]
    displacement: float

    @property
    def is_passed(self) -> bool:
        limits = zip(self.yaw_rate_ratios, YAW_RATE_LIMITS.values(), strict=True)
        is_stable = all(ratio <= limit for ratio, limit in limits)
        is_judged = abs(self.scalar) >= DISPLACEMENT_FROM
        return is_stable and (not is_judged or self.displacement >= LEAST_DISPLACEMENT)


def _text(value: float, unit: str) -> str:
    return "not known" if math.isnan(value) else f"{value:.3f} {unit}"


SINE_WITH_DWELL = SineWithDwell(speed=80 / 3.6, scalar=5.0, duration=6.0, speed_hold=HOLD)
"""80 km/h, then coasting; of the amplitudes of the series that from which all is judged."""
