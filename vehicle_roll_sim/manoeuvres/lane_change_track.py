"""The tracks of ISO 3888: three lanes between cones, and the path through their middle.

x is measured from the beginning of the track, y from the middle of the first lane, both in m, and
the first lane change is to the left, towards positive y.
"""

import dataclasses

import numpy as np

OBSTACLE_GAP, LEAST_EXIT = 1.0, 3.0
"""m (ISO 3888-2): sideways between the second lane and the two others, and the least width of the
last lane."""
LANE_OFFSET = 3.5
"""m (ISO 3888-1): sideways between the right borders of the second lane and of the two others."""
CONES_OF_A_BORDER = 3
"""At the beginning of a lane, in its middle and at its end."""


@dataclasses.dataclass(frozen=True)
class Lane:
    """From x to x, and from y of the right border to y of the left one (m)."""

    start: float
    end: float
    right: float
    left: float

    @property
    def middle(self) -> float:
        return (self.right + self.left) / 2


@dataclasses.dataclass(frozen=True)
class Track:
    """Three lanes in the order in which they are driven; side -1: mirrored."""

    lanes: tuple[Lane, Lane, Lane]
    side: float = 1.0

    @property
    def end(self) -> float:
        return self.lanes[-1].end

    @property
    def cones(self) -> np.ndarray:
        """Places (n, 2) on the borders, which the base circles of the cones touch from outside."""
        places = [
            (x, self.side * border)
            for lane in self.lanes
            for x in np.linspace(lane.start, lane.end, CONES_OF_A_BORDER).tolist()
            for border in (lane.left, lane.right)
        ]
        return np.array(places)

    def missed_lanes(self, x: np.ndarray, y: np.ndarray) -> list[bool]:
        """For each lane whether a way through these places (m) is beside it at any of them."""
        y = self.side * y
        return [
            bool(np.any((x >= lane.start) & (x <= lane.end) & ((y < lane.right) | (y > lane.left))))
            for lane in self.lanes
        ]

    def path(self, x: np.ndarray) -> np.ndarray:
        """y of the path: the middle of each lane, and between two lanes the curve

        s = 10 t^3 - 15 t^4 + 6 t^5, t = 0 ... 1, without a step in direction or curvature. Ahead of
        the track and behind it the path goes straight on.
        """
        first = self.lanes[0]
        y = np.full(np.shape(x), first.middle)
        for before, after in zip(self.lanes, self.lanes[1:], strict=False):
            t = np.clip((x - before.end) / (after.start - before.end), 0.0, 1.0)
            y += (after.middle - before.middle) * t**3 * (10 - 15 * t + 6 * t**2)
        return self.side * y


def obstacle_avoidance_track(width: float, side: float = 1.0) -> Track:
    """ISO 3888-2 for a vehicle of that width (m): 12, 13.5, 11, 12.5 and 12 m, 61 m in all.

    The borders of the first and the last lane that face the second one lie on one line.
    """
    facing = (1.1 * width + 0.25) / 2
    beyond = facing + OBSTACLE_GAP
    lanes = (
        Lane(0.0, 12.0, -facing, facing),
        Lane(25.5, 36.5, beyond, beyond + width + 1.0),
        Lane(49.0, 61.0, facing - max(1.3 * width + 0.25, LEAST_EXIT), facing),
    )
    return Track(lanes, side)


def double_lane_change_track(width: float, side: float = 1.0) -> Track:
    """ISO 3888-1 for a vehicle of that width (m): 15, 30, 25, 25, 15 and 15 m, 125 m in all.

    The last two sections are one lane. The right borders of the first and the last lane lie on one
    line.
    """
    right = -(1.1 * width + 0.25) / 2
    beyond = right + LANE_OFFSET
    lanes = (
        Lane(0.0, 15.0, right, -right),
        Lane(45.0, 70.0, beyond, beyond + 1.2 * width + 0.25),
        Lane(95.0, 125.0, right, right + 1.3 * width + 0.25),
    )
    return Track(lanes, side)
