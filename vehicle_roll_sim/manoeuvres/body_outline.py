"""The outline of a vehicle's body on the ground, and the cones that it strikes."""

import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.vehicle.parameters import Vehicle

TIRE_WIDTH = 0.205
"""m: that of a 205/60R15, the reference vehicle's tire; vehicle files have none."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class BodySettings:
    """How wide and how long the body is, which vehicle files do not say."""

    vehicle_width: float = parameter(
        f"width of the body; 0: the larger track and {TIRE_WIDTH:g} m of tire",
        "m",
        0.0,
        10.0,
        default=0.0,
    )
    front_overhang: float = parameter("body ahead of the front axle", "m", 0.0, 10.0, default=0.8)
    rear_overhang: float = parameter("body behind the rear axle", "m", 0.0, 10.0, default=0.9)

    def outline_of(self, vehicle: Vehicle) -> "Outline":
        """Raises InputError for a body that is narrower than the larger track."""
        track = max(vehicle.front_track, vehicle.rear_track)
        if self.vehicle_width and self.vehicle_width < track:
            allowed = f"at least the larger track, {track:g} m"
            raise InputError("vehicle_width", self.vehicle_width, allowed)
        return Outline(
            width=self.vehicle_width or track + TIRE_WIDTH,
            ahead=vehicle.cg_to_front_axle + self.front_overhang,
            behind=vehicle.cg_to_rear_axle + self.rear_overhang,
        )


@dataclasses.dataclass(frozen=True)
class Outline:
    """A rectangle: its width, and how far it reaches ahead of the sprung c.g. and behind it (m).

    It turns with the yaw angle and neither leans nor pitches.
    """

    width: float
    ahead: float
    behind: float

    def strike_times(self, history: History, cones: np.ndarray) -> np.ndarray:
        """When each of the cones (n, 2), points on the ground, comes to be inside (s); nan: never.

        Seen from the vehicle a cone moves on a straight line from one sample to the next: with
        samples 10 ms apart that is within a millimetre of how it does. A cone on the edge is not
        inside.
        """
        time = history["time"]
        if len(time) < 2:
            return np.full(len(cones), np.nan)
        entry = self._entries(self._seen_from_the_vehicle(history, cones))
        struck = ~np.isnan(entry)
        first = np.argmax(struck, axis=0)
        share = entry[first, np.arange(len(cones))]
        return time[first] + share * (time[first + 1] - time[first])

    def _seen_from_the_vehicle(self, history: History, cones: np.ndarray) -> np.ndarray:
        """Places of the cones, ahead and to the left, shape (2, samples, cones) (m)."""
        x, y, yaw = (history[name][:, np.newaxis] for name in ("x", "y", "yaw"))
        east, north = cones[:, 0] - x, cones[:, 1] - y
        sine, cosine = np.sin(yaw), np.cos(yaw)
        return np.array([east * cosine + north * sine, north * cosine - east * sine])

    def _entries(self, places: np.ndarray) -> np.ndarray:
        """Share of each interval after which a cone is inside the rectangle; nan: not in it."""
        begin, way = places[:, :-1], np.diff(places, axis=1)
        least = np.array([-self.behind, -self.width / 2])[:, np.newaxis, np.newaxis]
        most = np.array([self.ahead, self.width / 2])[:, np.newaxis, np.newaxis]
        with np.errstate(divide="ignore", invalid="ignore"):
            crossings = np.sort([(least - begin) / way, (most - begin) / way], axis=0)
        enters = np.maximum(crossings[0].max(axis=0), 0.0)
        leaves = np.minimum(crossings[1].min(axis=0), 1.0)
        return np.where(enters < leaves, enters, np.nan)
