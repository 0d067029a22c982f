"""Closed-loop manoeuvres in which a driver follows a path."""

import abc
import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.base import STEEPEST, Manoeuvre
from vehicle_roll_sim.manoeuvres.driver.preview_steering import PreviewSteering
from vehicle_roll_sim.manoeuvres.driver.single_track import SingleTrack
from vehicle_roll_sim.manoeuvres.handwheel import LARGEST_HANDWHEEL
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.steering_gear import Gear, ratio_ahead, to_road_wheels


@dataclasses.dataclass(frozen=True, kw_only=True)
class DriverSettings:
    """Parameters of the path-following driver."""

    preview_time: float = parameter("preview time of the driver", "s", 0.05, 5.0)
    driver_delay: float = parameter("response delay of the driver", "s", 0.0, 2.0, default=0.0)
    handwheel_rate: float = parameter(
        "largest rate of the handwheel angle", "deg/s", 1.0, 1e5, default=1000.0
    )
    handwheel_limit: float = parameter(
        "largest handwheel angle; also limited to 60 deg at the road wheels",
        "deg",
        1.0,
        LARGEST_HANDWHEEL,
        default=360.0,
    )


@dataclasses.dataclass(frozen=True, kw_only=True)
class PathFollowing(DriverSettings, Manoeuvre):
    """A driver follows a path; `for_vehicle` sets the driver's internal model of the vehicle."""

    gear: Gear = math.nan
    model: SingleTrack | None = None

    needs_vehicle = True

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "PathFollowing":
        """A copy with the steering gear and the linear single-track model of the vehicle."""
        ready = super().for_vehicle(vehicle, options)
        return dataclasses.replace(ready, gear=vehicle.gear, model=SingleTrack.of(vehicle))

    @abc.abstractmethod
    def path_ahead(self, x: float, y: float, distance: float) -> np.ndarray:
        """Points (n, 2) of the path (m), in order, from beside (x, y) to beyond `distance` (m)."""

    def steering(self) -> PreviewSteering:
        """A new steering controller for one run."""
        limit = float(to_road_wheels(self.handwheel_limit, self.gear))
        return PreviewSteering(
            self.model,
            self.path_ahead,
            preview=self.preview_time,
            delay=self.driver_delay,
            rate=math.radians(self.handwheel_rate / ratio_ahead(self.gear)),
            limit=math.radians(min(limit, STEEPEST)),
        )
