"""Manoeuvres defined by handwheel angle (deg), independent of the vehicle's steering ratio."""

import abc
import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import LONGEST, STEEPEST, Manoeuvre, OpenLoop
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

LARGEST_HANDWHEEL = 1440.0
"""deg: four turns from straight ahead."""
HOLD = 2000.0
"""N m s/m: default speed-hold gain; keeps the speed within a few cm/s of the entry speed."""
METRES_PER_SECOND_OF_A_MPH = 0.44704
ROUNDING = 1e-12
"""Relative tolerance for rounding in angles computed as a multiple of another angle."""


def largest_handwheel(steering_ratio: float) -> float:
    """Largest handwheel angle (deg): four turns or 60 deg at the road wheels, if that is less."""
    return min(LARGEST_HANDWHEEL, STEEPEST * steering_ratio)


def at_the_road_wheels(angle: float, steering_ratio: float) -> str:
    """A handwheel angle (deg) in words, with the corresponding road-wheel angle."""
    road_wheel = f"{angle / steering_ratio:g} deg at the road wheels"
    return f"{angle:g} deg, which is {road_wheel} with steering_ratio {steering_ratio:g}"


@dataclasses.dataclass(frozen=True, kw_only=True)
class HandwheelManoeuvre(Manoeuvre):
    """A manoeuvre defined by handwheel angle; `for_vehicle` sets the steering ratio, nan before."""

    start: float = parameter("time at which steering begins", "s", 0.0, LONGEST, default=1.0)
    steering_ratio: float = math.nan

    needs_vehicle = True

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "HandwheelManoeuvre":
        """A copy with the vehicle's steering ratio.

        A standard's own handwheel angle ends at the largest one of the vehicle. Raises InputError
        if any other exceeds it.
        """
        ready = dataclasses.replace(self, steering_ratio=vehicle.steering_ratio)
        return ready.filled_in(vehicle, options).within_the_wheels().checked()

    def filled_in(self, vehicle: Vehicle, options: Options) -> "HandwheelManoeuvre":
        """A copy with any other values that depend on the vehicle and its model."""
        return self

    def within_the_wheels(self) -> "HandwheelManoeuvre":
        """Reduce a standard's own angle to the largest one of the vehicle; keep any other."""
        return self

    @property
    @abc.abstractmethod
    def amplitude(self) -> float:
        """The largest handwheel angle (deg, left positive)."""

    def limit_line(self) -> dict[str, str]:
        """A line of the report if the largest angle is the largest one of the vehicle."""
        largest = largest_handwheel(self.steering_ratio)
        if not math.isclose(abs(self.amplitude), largest, rel_tol=ROUNDING):
            return {}
        return {"handwheel ends at": at_the_road_wheels(largest, self.steering_ratio)}

    def checked(self) -> "HandwheelManoeuvre":
        """Return self; raises InputError if `amplitude` exceeds the largest handwheel angle."""
        largest = largest_handwheel(self.steering_ratio)
        if not abs(self.amplitude) <= largest * (1.0 + ROUNDING):
            allowed = f"at most {at_the_road_wheels(largest, self.steering_ratio)}"
            raise InputError("handwheel angle", self.amplitude, allowed)
        return self

    def road_wheel(self, handwheel: np.ndarray) -> np.ndarray:
        """Convert handwheel angles (deg) to road-wheel angles (rad)."""
        return np.radians(handwheel / self.steering_ratio)


@dataclasses.dataclass(frozen=True, kw_only=True)
class HandwheelProgramme(HandwheelManoeuvre, OpenLoop):
    """An open-loop manoeuvre: the handwheel angle is a function of time."""

    @abc.abstractmethod
    def handwheel(self, times: np.ndarray) -> np.ndarray:
        """Handwheel angles (deg, left positive) at `times` (s)."""

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        commands["steering"] = self.road_wheel(self.handwheel(times))


def ramp(times: np.ndarray, start: float, rate: float, amplitude: float) -> np.ndarray:
    """Ramp angles (n,) (deg) at `times` (n,) (s).

    0 until `start` (s), then at `rate` (deg/s) to `amplitude` (deg, signed), where it is held.
    """
    turned = np.clip(rate * (times - start), 0.0, abs(amplitude))
    return math.copysign(1.0, amplitude) * turned
