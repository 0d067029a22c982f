"""Manoeuvres whose amplitude is a multiple of the handwheel angle at 0.3 g."""

import dataclasses
import math

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.handwheel import (
    LARGEST_HANDWHEEL,
    HandwheelManoeuvre,
    largest_handwheel,
)
from vehicle_roll_sim.manoeuvres.slowly_increasing_steer import steering_at_03g
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle


@dataclasses.dataclass(frozen=True, kw_only=True)
class ScaledManoeuvre(HandwheelManoeuvre):
    """Straight ahead; then the throttle is dropped and the handwheel is turned.

    The handwheel amplitude is `scalar` times the angle at a lateral acceleration of 0.3 g.
    """

    scalar: float = parameter(
        "ratio of the handwheel amplitude to the handwheel angle at 0.3 g, left positive",
        "",
        -100.0,
        100.0,
    )
    steering_at_03g: float = parameter(
        "handwheel angle at 0.3 g; 0: determined by slowly-increasing-steer runs",
        "deg",
        0.0,
        LARGEST_HANDWHEEL,
        default=0.0,
    )

    largest_of_standard: float = 0.0
    """The largest scalar of the standard: up to it, amplitudes end where the road wheels do."""

    @property
    def amplitude(self) -> float:
        return self.scalar * self.steering_at_03g

    @property
    def throttle_dropped(self) -> float:
        return self.start

    def filled_in(self, vehicle: Vehicle, options: Options) -> "ScaledManoeuvre":
        found = self.steering_at_03g or steering_at_03g(vehicle, options)
        return dataclasses.replace(self, steering_at_03g=found)

    def within_the_wheels(self) -> "ScaledManoeuvre":
        largest = largest_handwheel(self.gear)
        if abs(self.scalar) > self.largest_of_standard or abs(self.amplitude) <= largest:
            return self
        reached = math.copysign(largest / self.steering_at_03g, self.scalar)
        return dataclasses.replace(self, scalar=reached)

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        return {
            "handwheel angle at 0.3 g": f"{self.steering_at_03g:.3f} deg",
            "handwheel amplitude": f"{self.amplitude:.3f} deg",
            **self.limit_line(),
        }
