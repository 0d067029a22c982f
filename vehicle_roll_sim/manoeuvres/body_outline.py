"""The outline of a vehicle's body on the ground, and detection of cone strikes."""

import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.vehicle.body_parameters import FRONT_OVERHANG, REAR_OVERHANG, TIRE_WIDTH
from vehicle_roll_sim.vehicle.parameters import Vehicle


@dataclasses.dataclass(frozen=True, kw_only=True)
class BodySettings:
    """Width and overhangs of the body, which vehicle files do not specify."""

    vehicle_width: float = parameter(
        f"width of the body; 0: the larger track width plus a tire width of {TIRE_WIDTH:g} m",
        "m",
        0.0,
        10.0,
        default=0.0,
    )
    front_overhang: float = parameter(
        "length of the body ahead of the front axle", "m", 0.0, 10.0, default=FRONT_OVERHANG
    )
    rear_overhang: float = parameter(
        "length of the body behind the rear axle", "m", 0.0, 10.0, default=REAR_OVERHANG
    )

    def outline_of(self, vehicle: Vehicle) -> "Outline":
        """The outline; raises InputError if the body is narrower than the larger track width."""
        track = max(vehicle.front_track, vehicle.rear_track)
        if self.vehicle_width and self.vehicle_width < track:
            allowed = f"at least the larger track width, {track:g} m"
            raise InputError("vehicle_width", self.vehicle_width, allowed)
        return Outline(
            width=self.vehicle_width or track + TIRE_WIDTH,
            ahead=vehicle.cg_to_front_axle + self.front_overhang,
            behind=vehicle.cg_to_rear_axle + self.rear_overhang,
            aside=vehicle.cg_offset or 0.0,
        )


@dataclasses.dataclass(frozen=True)
class Outline:
    """A rectangle: its width, and its extent ahead of and behind the sprung c.g. (m).

    aside: distance of the c.g. to the left of its middle (m). It rotates with the yaw
    angle; roll and pitch are ignored.
    """

    width: float
    ahead: float
    behind: float
    aside: float = 0.0

    def strike_times(self, history: History, cones: np.ndarray) -> np.ndarray:
        """Time at which each cone is struck, shape (n,) (s); nan if it is not.

        cones: points on the ground, shape (n, 2) (m). A cone is struck when it enters the
        rectangle; a cone on its edge is not inside. Between samples a cone is assumed to move in a
        straight line relative to the vehicle: accurate to a millimetre for samples 10 ms apart.
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
        """Positions of the cones relative to the vehicle, shape (2, samples, cones) (m).

        First index: ahead of the sprung c.g., and to its left.
        """
        x, y, yaw = (history[name][:, np.newaxis] for name in ("x", "y", "yaw"))
        east, north = cones[:, 0] - x, cones[:, 1] - y
        sine, cosine = np.sin(yaw), np.cos(yaw)
        return np.array([east * cosine + north * sine, north * cosine - east * sine])

    def _entries(self, places: np.ndarray) -> np.ndarray:
        """Fraction of each sample interval at which a cone enters the rectangle, else nan.

        Shape (samples - 1, cones).
        """
        begin, way = places[:, :-1], np.diff(places, axis=1)
        right, left = -self.width / 2 - self.aside, self.width / 2 - self.aside
        least = np.array([-self.behind, right])[:, np.newaxis, np.newaxis]
        most = np.array([self.ahead, left])[:, np.newaxis, np.newaxis]
        with np.errstate(divide="ignore", invalid="ignore"):
            crossings = np.sort([(least - begin) / way, (most - begin) / way], axis=0)
        enters = np.maximum(crossings[0].max(axis=0), 0.0)
        leaves = np.minimum(crossings[1].min(axis=0), 1.0)
        return np.where(enters < leaves, enters, np.nan)
