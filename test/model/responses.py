"""Responses of the models to the step and ramp steers of the source, and what is read off them.

Steady is the mean over the last half second of the step steer, peak the largest value at the steps.
"""

import dataclasses
import functools
from collections.abc import Callable

import numpy as np
from programmes import ramp_and_hold

from vehicle_roll_sim import LF, LR, RF, RR, Options, Simulation, Vehicle
from vehicle_roll_sim.simulation.run import run

SPEED = 50 / 3.6
STEP_STEER = ramp_and_hold(1.0, 40.0, 4.0, speed_hold_gain=2000.0, speed_hold_target=SPEED)
RAMP_STEER = ramp_and_hold(1.0, 4.0, 12.0)
DURATION = {STEP_STEER: 4.0, RAMP_STEER: 9.0}
"""s"""
HALF_A_SECOND = 500
"""Steps."""
VARIANTS = {
    "no roll centre": {"no_roll_centre": True},
    "upright": {"tire_normal_to_ground": True},
    "each side": {"link_load_transfer": "asymmetric"},
}
"""Options of model 1; every other name is a model's."""


@dataclasses.dataclass(frozen=True)
class Response:
    """A run: time (s), roll (deg), roll rate (rad/s), loads (N, four columns); event times (s)."""

    time: np.ndarray
    roll: np.ndarray
    roll_rate: np.ndarray
    load: np.ndarray
    lift_off: np.ndarray
    rollover: float

    @property
    def peak_roll(self) -> float:
        return self.roll.max()

    @property
    def steady_roll(self) -> float:
        return steady(self.roll)

    @property
    def first_lift_off(self) -> float:
        return np.nanmin(self.lift_off)

    @property
    def front_load_transfer(self) -> np.ndarray:
        return (self.load[:, RF] - self.load[:, LF]) / 2

    @property
    def rear_load_transfer(self) -> np.ndarray:
        return (self.load[:, RR] - self.load[:, LR]) / 2

    @property
    def frequency(self) -> float:
        """Damped frequency of the roll (Hz): one period, from the first peak to the next."""
        rate, time = self.roll_rate, self.time
        changes = np.flatnonzero((rate[:-1] > 0) != (rate[1:] > 0))
        changes = changes[time[changes] > 1.1]  # s: while the steering is held
        share = rate[changes] / (rate[changes] - rate[changes + 1])
        crossings = time[changes] + share * np.diff(time)[changes]
        return 1 / (crossings[2] - crossings[0])


def steady(values: np.ndarray) -> np.ndarray:
    return values[-HALF_A_SECOND:].mean(axis=0)


def more(value, other):
    """By what share a value is above another."""
    return value / other - 1


def difference(one: Response, other: Response) -> np.ndarray:
    """Of the roll angles (deg), at the steps that both have."""
    both = min(len(one.roll), len(other.roll))
    return np.abs(one.roll[:both] - other.roll[:both])


def responder(vehicle: Vehicle) -> Callable[[str, Callable], Response]:
    """The response of a model or option to a manoeuvre, run once."""

    @functools.cache
    def response(name: str, programme) -> Response:
        simulation = Simulation(vehicle, Options(**VARIANTS.get(name, {"model": name})))
        history = run(simulation, programme, DURATION[programme], sample=0.001)
        events = simulation.events
        return Response(
            history["time"],
            np.degrees(history["roll"]),
            history["roll_rate"],
            history.wheels("normal_force"),
            events.lift_off_time.copy(),
            float(events.rollover_time[0]),
        )

    return response
