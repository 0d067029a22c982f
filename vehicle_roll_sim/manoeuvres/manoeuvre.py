"""A manoeuvre: steering as a function of time, and the conditions it is driven under."""

import abc
import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.simulation.simulation import DEFAULT_SPEED, MAXIMUM_SPEED

STEEPEST = 60.0
"""deg: road-wheel angles beyond it belong to no road vehicle."""
LONGEST = 86_400.0
"""s"""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Manoeuvre(abc.ABC):
    """Speed at entry, length and speed hold: what every manoeuvre has."""

    speed: float = parameter("speed at entry", "m/s", 0.0, MAXIMUM_SPEED, default=DEFAULT_SPEED)
    duration: float = parameter("simulated time", "s", 0.0, LONGEST)
    speed_hold: float = parameter(
        "torque at each rear wheel per m/s below the entry speed",
        "N m s/m",
        0.0,
        1e6,
        default=0.0,
    )

    @abc.abstractmethod
    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        """Fill in `commands`, all 0 so far, one COMMAND record for each of `times` (s)."""

    def __call__(self, times: np.ndarray) -> np.ndarray:
        """The manoeuvre as a Programme: one COMMAND record for each of `times` (s)."""
        commands = np.zeros(len(times), COMMAND)
        self.drive(times, commands)
        commands["speed_hold_gain"] = self.speed_hold
        commands["speed_hold_target"] = self.speed
        return commands


@dataclasses.dataclass(frozen=True, kw_only=True)
class RampAndHold(Manoeuvre):
    """Straight ahead, then the steering turns at a constant rate to an angle that is held."""

    amplitude: float = parameter(
        "road-wheel angle that is held, left positive", "deg", -STEEPEST, STEEPEST
    )
    rate: float = parameter("rate of the road-wheel angle", "deg/s", 1e-3, 1e5)
    start: float = parameter("when the steering begins", "s", 0.0, LONGEST, default=1.0)

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        turned = np.clip(self.rate * (times - self.start), 0.0, abs(self.amplitude))
        commands["steering"] = math.copysign(1.0, self.amplitude) * np.radians(turned)


STANDARD = {
    "step_steer": RampAndHold(amplitude=4.0, rate=40.0, duration=4.0, speed_hold=2000.0),
    "ramp_steer": RampAndHold(amplitude=12.0, rate=4.0, duration=9.0),
    "j_turn": RampAndHold(amplitude=10.0, rate=40.0, duration=6.0),
}
"""The manoeuvres of Shim and Ghike (2007), with the conditions under which they are compared."""


def manoeuvre_named(name: str) -> Manoeuvre:
    """The standard manoeuvre of that name; raises InputError naming the ones there are."""
    if name not in STANDARD:
        raise InputError("MANOEUVRE", name, "one of " + ", ".join(STANDARD))
    return STANDARD[name]
