"""A sine of rising frequency at the road wheels, and the frequency response evaluated from it."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.base import ADAPTED, LONGEST, STEEPEST, OpenLoop
from vehicle_roll_sim.runs.history import History

WEAKEST = 0.02
"""Smallest share of the largest Fourier coefficient of the steering that is divided by."""
HIGHEST = 10.0
"""Hz"""


@dataclasses.dataclass(frozen=True, kw_only=True)
class SweptSteer(OpenLoop):
    """Straight ahead, then a sine whose frequency rises linearly, then straight ahead.

    The continuous sinusoidal input of ISO 7401, its frequencies in one run.
    """

    amplitude: float = parameter("road-wheel angle", "deg", -STEEPEST, STEEPEST)
    lowest_frequency: float = parameter("frequency at the beginning", "Hz", 0.01, 10.0, default=0.2)
    highest_frequency: float = parameter("frequency at the end", "Hz", 0.01, 10.0, default=3.0)
    sweep: float = parameter("duration of the sine", "s", 1.0, LONGEST, default=16.0)
    start: float = parameter("time at which steering begins", "s", 0.0, LONGEST, default=1.0)

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        since = np.clip(times - self.start, 0.0, self.sweep)
        rise = (self.highest_frequency - self.lowest_frequency) / self.sweep
        turns = (self.lowest_frequency + 0.5 * rise * since) * since
        on = since < self.sweep
        angle = np.radians(self.amplitude) * np.sin(2.0 * math.pi * turns)
        commands["steering"] = np.where(on, angle, 0.0)


def frequency_response(history: History, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (Hz) and complex response of a signal to the steering, both (n,), up to HIGHEST.

    The ratio of the discrete Fourier transforms of whole runs, which is exact for a linear vehicle
    that moves straight ahead at the beginning and at the end. Samples are evenly spaced. The
    response is nan at frequencies that the steering does not have.
    """
    time = history["time"]
    interval = float(np.diff(time).mean()) if len(time) > 1 else 1.0
    steering, answer = (np.fft.rfft(history[each]) for each in ("steering", name))
    frequencies = np.fft.rfftfreq(len(time), interval)
    has = np.abs(steering) > WEAKEST * np.abs(steering).max(initial=0.0)
    ratio = np.full(len(steering), np.nan, complex)
    np.divide(answer, steering, out=ratio, where=has)
    shown = frequencies <= HIGHEST
    return frequencies[shown], ratio[shown]


SWEPT_STEER = SweptSteer(speed=100 / 3.6, amplitude=0.5, duration=19.0, speed_hold=ADAPTED)
"""100 km/h, 0.5 deg at the road wheels, 0.2 to 3 Hz."""
