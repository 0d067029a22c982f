"""The steady-state circle of ISO 4138 at constant speed: understeer and roll gradients."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.manoeuvres.handwheel import HOLD
from vehicle_roll_sim.manoeuvres.slowly_increasing_steer import (
    SlowlyIncreasingSteer,
    band_of_the_fit,
)
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.history import History
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle


@dataclasses.dataclass(frozen=True, kw_only=True)
class SteadyStateCircle(SlowlyIncreasingSteer):
    """A steer so slow that every moment is a steady turn; `for_vehicle` brings the wheelbase."""

    wheelbase: float = math.nan

    def filled_in(self, vehicle: Vehicle, options: Options) -> "SteadyStateCircle":
        """With the wheelbase (m), and the time at which the vehicle passes 0.375 g."""
        wheelbase = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
        return dataclasses.replace(super().filled_in(vehicle, options), wheelbase=wheelbase)

    def gradients(self, history: History) -> tuple[float, float]:
        """Understeer gradient, at the road wheels, and roll gradient (deg per m/s^2).

        Slopes over lateral acceleration of steering - wheelbase * yaw rate / speed, which is 0 in
        a turn as the wheels point, and of the roll angle, between 0.1 and 0.375 g. nan without.
        """
        band = band_of_the_fit(history)
        if band is None:
            return math.nan, math.nan
        acceleration = history["lateral_acceleration"][band]
        needed = self.wheelbase * history["yaw_rate"] / history["u"]
        angles = (history["steering"] - needed, history["roll"])
        slopes = [np.polyfit(acceleration, angle[band], 1)[0] for angle in angles]
        return math.degrees(slopes[0]), math.degrees(slopes[1])

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        labels = ("understeer gradient", "roll gradient")
        return {
            label: "0.375 g not reached" if math.isnan(slope) else f"{slope:.4f} deg/(m/s^2)"
            for label, slope in zip(labels, self.gradients(history), strict=True)
        }


STEADY_STATE_CIRCLE = SteadyStateCircle(
    speed=100 / 3.6, handwheel_angle=30.0, handwheel_rate=0.5, duration=62.0, speed_hold=HOLD
)
"""100 km/h, and 0.5 deg/s up to 30 deg."""
