"""The step steer of ISO 7401: how quickly the vehicle answers, at a given lateral acceleration."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import LONGEST
from vehicle_roll_sim.manoeuvres.handwheel import (
    HOLD,
    LARGEST_HANDWHEEL,
    HandwheelProgramme,
)
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle

STEADY_WINDOW = 0.5
"""s at the end of a run whose mean is the steady value."""
CLOSE_ENOUGH = 1e-3
"""m/s^2 from the lateral acceleration that is wanted."""
ATTEMPTS = 20
SLOWEST = 1.0
"""m/s: speed of the first guess at least."""
RESPONDED = 0.9
"""Share of the steady value that counts as the answer."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class IsoStepSteer(HandwheelProgramme):
    """Straight ahead at a speed that is held, then the handwheel is turned as in a step."""

    lateral_acceleration: float = parameter(
        "steady lateral acceleration that is wanted, left positive", "m/s^2", -20.0, 20.0
    )
    handwheel_angle: float = parameter(
        "handwheel angle, left positive; 0: that of the lateral acceleration",
        "deg",
        -LARGEST_HANDWHEEL,
        LARGEST_HANDWHEEL,
        default=0.0,
    )
    rise: float = parameter("time in which the handwheel is turned", "s", 1e-3, LONGEST)

    @property
    def amplitude(self) -> float:
        return self.handwheel_angle

    def handwheel(self, times: np.ndarray) -> np.ndarray:
        return self.handwheel_angle * np.clip((times - self.start) / self.rise, 0.0, 1.0)

    def filled_in(self, vehicle: Vehicle, options: Options) -> "IsoStepSteer":
        """With the handwheel angle; raises InputError if no step gives the acceleration."""
        if self.handwheel_angle or not self.lateral_acceleration:
            return self
        angle = self._angle_for_acceleration(vehicle, options)
        return dataclasses.replace(self, handwheel_angle=angle)

    def _angle_for_acceleration(self, vehicle: Vehicle, options: Options) -> float:
        """Handwheel angle (deg) for the steady acceleration, by the secant method.

        It begins with a vehicle that turns as its wheels point.
        """
        wanted = self.lateral_acceleration
        wheelbase = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
        curvature = wanted / max(self.speed, SLOWEST) ** 2
        before, missed_before = 0.0, -wanted
        angle = math.degrees(wheelbase * curvature) * self.steering_ratio
        for _ in range(ATTEMPTS):
            missed = self._steady_acceleration(angle, vehicle, options) - wanted
            if abs(missed) < CLOSE_ENOUGH:
                return angle
            if math.isnan(missed) or missed == missed_before or abs(angle) > LARGEST_HANDWHEEL:
                break
            step = missed * (angle - before) / (missed - missed_before)
            before, missed_before, angle = angle, missed, angle - step
        problem = f"no step of the handwheel gives {wanted:g} m/s^2"
        allowed = "less of it, another speed, or the handwheel angle"
        raise InputError("lateral_acceleration", wanted, allowed, problem)

    def _steady_acceleration(self, angle: float, vehicle: Vehicle, options: Options) -> float:
        """Lateral acceleration (m/s^2) at the end of a step to `angle` (deg); nan if it fails."""
        simulation = Simulation(vehicle, options)
        simulation.reset(self.speed)
        step = dataclasses.replace(self, handwheel_angle=angle)
        history = run(simulation, step, self.duration)
        return steady(history, "lateral_acceleration", self.duration)

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
        """Response time (s) of a signal, and its overshoot over the steady value.

        From half the steering to 90 % of the steady value, linear between samples (ISO 7401).
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
"""Label and signal of each answer in the report."""
ISO_STEP_STEER = IsoStepSteer(
    speed=100 / 3.6, lateral_acceleration=4.0, rise=0.15, duration=6.0, speed_hold=HOLD
)
"""100 km/h, 4 m/s^2; 10 to 90 % of the handwheel angle within 0.12 s."""


def steady(history: History, name: str, duration: float) -> float:
    """Mean of the end of a run of that duration (s); nan if it ended before."""
    time = history["time"]
    if time[-1] < duration - STEADY_WINDOW:
        return math.nan
    return float(np.mean(history[name][time > time[-1] - STEADY_WINDOW]))


def _text(value: float, unit: str) -> str:
    return "none" if math.isnan(value) else f"{value:.3f} {unit}"
