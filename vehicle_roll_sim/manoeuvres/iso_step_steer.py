"""Step steer of ISO 7401: response times at a given steady lateral acceleration."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.manoeuvres.base import ADAPTED
from vehicle_roll_sim.manoeuvres.turn_in import TurnIn, steady
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme

RESPONDED = 0.9
"""The response time ends at this share of the steady value."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class IsoStepSteer(TurnIn):
    """Straight ahead at constant speed, then a near step of the handwheel angle."""

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        acceleration = steady(history, "lateral_acceleration", self.duration)
        lines = {
            "handwheel angle": f"{self.handwheel_angle:.3f} deg",
            "steady acceleration": _text(acceleration, "m/s^2"),
        }
        for label, name in ANSWERS.items():
            time, overshoot = self.response(history, name)
            text = f"{_text(time, 's')}, overshoot {_text(100 * overshoot, '%')}"
            lines[f"{label} response"] = text
        return lines

    def response(self, history: History, name: str) -> tuple[float, float]:
        """Response time (s) of a signal, and its overshoot as a fraction of the steady value.

        ISO 7401: the response time runs from 50 % of the steering input to 90 % of the steady
        value, interpolated linearly between samples. nan without a steady value.
        """
        final = steady(history, name, self.duration)
        if math.isnan(final) or final == 0.0:
            return math.nan, math.nan
        share = history[name] / final
        first = int(np.argmax(share >= RESPONDED))
        window = slice(max(first - 1, 0), first + 1)
        answered = np.interp(RESPONDED, share[window], history["time"][window])
        return float(answered - self.start - self.rise / 2), float(share.max() - 1.0)


ANSWERS = {"yaw rate": "yaw_rate", "acceleration": "lateral_acceleration", "roll": "roll"}
"""Label and signal of each response in the report."""
ISO_STEP_STEER = IsoStepSteer(
    speed=100 / 3.6, lateral_acceleration=4.0, rise=0.15, duration=6.0, speed_hold=ADAPTED
)
"""100 km/h, 4 m/s^2; the handwheel angle rises from 10 to 90 % within 0.12 s."""


def _text(value: float, unit: str) -> str:
    return "none" if math.isnan(value) else f"{value:.3f} {unit}"
