"""Steady-state circular tests of ISO 4138: at constant speed, radius or handwheel angle."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import ADAPTED
from vehicle_roll_sim.manoeuvres.driver.path_following import PathFollowing
from vehicle_roll_sim.manoeuvres.handwheel import LARGEST_HANDWHEEL, HandwheelManoeuvre, ramp
from vehicle_roll_sim.manoeuvres.slowly_increasing_steer import SlowlyIncreasingSteer
from vehicle_roll_sim.manoeuvres.steady_turn import RisingSpeed, RisingSpeedDriver, SteadyTurn
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

SMALLEST_RADIUS, LARGEST_RADIUS = 10.0, 1e4
"""m"""
POINT_EVERY = 0.01
"""rad along the circle: the chord between two points is at most R / 80000 inside the arc."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class SteadyStateCircle(SteadyTurn, SlowlyIncreasingSteer):
    """At constant speed: the handwheel is turned slowly."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class ConstantRadiusCircle(RisingSpeed, PathFollowing):
    """At constant radius: a driver follows a circle that is tangential to the initial heading."""

    radius: float = parameter(
        "radius of the circle, positive for a left turn", "m", -LARGEST_RADIUS, LARGEST_RADIUS
    )

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "ConstantRadiusCircle":
        if abs(self.radius) < SMALLEST_RADIUS:
            allowed = f"at least {SMALLEST_RADIUS:g} m, or at most -{SMALLEST_RADIUS:g} m"
            raise InputError("radius", self.radius, allowed)
        return super().for_vehicle(vehicle, options)

    def path_ahead(self, x: float, y: float, distance: float) -> np.ndarray:
        """Points (n, 2) (m) from a quarter circle behind the vehicle to one beyond `distance`."""
        beside = math.atan2(x, (self.radius - y) * math.copysign(1.0, self.radius))
        last = math.pi / 2 + distance / abs(self.radius)
        angles = beside + np.arange(-math.pi / 2, last, POINT_EVERY)
        across = self.radius * (1.0 - np.cos(angles))
        return np.column_stack((abs(self.radius) * np.sin(angles), across))

    def driver(self) -> RisingSpeedDriver:
        return RisingSpeedDriver(self, self.steering().angle)


@dataclasses.dataclass(frozen=True, kw_only=True)
class ConstantHandwheelCircle(RisingSpeed, HandwheelManoeuvre):
    """At constant handwheel angle: the handwheel is turned once and then held."""

    handwheel_angle: float = parameter(
        "constant handwheel angle, left positive", "deg", -LARGEST_HANDWHEEL, LARGEST_HANDWHEEL
    )
    handwheel_rate: float = parameter("rate of the handwheel angle", "deg/s", 1e-3, 1e5)

    @property
    def amplitude(self) -> float:
        return self.handwheel_angle

    def driver(self) -> RisingSpeedDriver:
        return RisingSpeedDriver(self, self._steer)

    def _steer(self, time: float, state) -> float:
        turned = ramp(np.array([time]), self.start, self.handwheel_rate, self.handwheel_angle)
        return float(self.road_wheel(turned)[0])


STEADY_STATE_CIRCLE = SteadyStateCircle(
    speed=100 / 3.6, handwheel_angle=30.0, handwheel_rate=0.5, duration=62.0, speed_hold=ADAPTED
)
"""100 km/h; handwheel at 0.5 deg/s up to 30 deg."""
CONSTANT_RADIUS_CIRCLE = ConstantRadiusCircle(
    speed=8.0, radius=100.0, preview_time=0.65, duration=250.0, speed_hold=ADAPTED
)
"""Radius 100 m; speed rising from 8 m/s."""
CONSTANT_HANDWHEEL_CIRCLE = ConstantHandwheelCircle(
    speed=8.0, handwheel_angle=30.0, handwheel_rate=30.0, duration=250.0, speed_hold=ADAPTED
)
"""Handwheel at 30 deg, speed rising from 8 m/s; the reference vehicle's radius is 78 to 85 m."""
