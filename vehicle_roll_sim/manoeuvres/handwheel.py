"""Manoeuvres defined by handwheel angle (deg), independent of the vehicle's steering ratio."""

import abc
import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import LONGEST, STEEPEST, Manoeuvre, OpenLoop
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.steering_gear import Gear, in_words, to_handwheel, to_road_wheels

LARGEST_HANDWHEEL = 1440.0
"""deg: four turns from straight ahead."""
METRES_PER_SECOND_OF_A_MPH = 0.44704
ROUNDING = 1e-12
"""Relative tolerance for rounding in angles computed as a multiple of another angle."""


def largest_handwheel(gear: Gear) -> float:
    """Largest handwheel angle (deg): four turns or 60 deg at the road wheels, if that is less."""
    return min(LARGEST_HANDWHEEL, float(to_handwheel(STEEPEST, gear)))


def at_the_road_wheels(angle: float, gear: Gear) -> str:
    """A handwheel angle (deg) in words, with the corresponding road-wheel angle."""
    road_wheel = f"{to_road_wheels(angle, gear):g} deg at the road wheels"
    return f"{angle:g} deg, which is {road_wheel} with {in_words(gear)}"


@dataclasses.dataclass(frozen=True, kw_only=True)
class HandwheelManoeuvre(Manoeuvre):
    """A manoeuvre defined by handwheel angle; `for_vehicle` sets the gear, nan before."""

    start: float = parameter("time at which steering begins", "s", 0.0, LONGEST, default=1.0)
    gear: Gear = math.nan

    needs_vehicle = True

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "HandwheelManoeuvre":
        """A copy with the vehicle's steering gear.

        A standard's own handwheel angle ends at the largest one of the vehicle. Raises InputError
        if any other exceeds it.
        """
        ready = dataclasses.replace(super().for_vehicle(vehicle, options), gear=vehicle.gear)
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
        largest = largest_handwheel(self.gear)
        if not math.isclose(abs(self.amplitude), largest, rel_tol=ROUNDING):
            return {}
        return {"handwheel ends at": at_the_road_wheels(largest, self.gear)}

    def checked(self) -> "HandwheelManoeuvre":
        """Return self; raises InputError if `amplitude` exceeds the largest handwheel angle."""
        largest = largest_handwheel(self.gear)
        if not abs(self.amplitude) <= largest * (1.0 + ROUNDING):
            allowed = f"at most {at_the_road_wheels(largest, self.gear)}"
            raise InputError("handwheel angle", self.amplitude, allowed)
        return self

    def road_wheel(self, handwheel: np.ndarray) -> np.ndarray:
        """Convert handwheel angles (deg) to road-wheel angles (rad).

        Raises InputError before `for_vehicle`, when there is no steering gear.
        """
        if isinstance(self.gear, float) and math.isnan(self.gear):
            raise InputError("gear", None, "a manoeuvre completed by for_vehicle(vehicle, options)")
        return np.radians(to_road_wheels(handwheel, self.gear))


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
