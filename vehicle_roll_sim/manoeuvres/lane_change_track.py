"""The tracks of ISO 3888: three lanes marked by cones, and the path through their centres.

x is measured from the beginning of the track, y from the centre line of the first lane, both in m.
The first lane change is to the left, towards positive y.
"""

import dataclasses

import numpy as np

OBSTACLE_GAP, LEAST_EXIT = 1.0, 3.0
"""m (ISO 3888-2): lateral gap between the second lane and the others; minimum width of the last."""
LANE_OFFSET = 3.5
"""m (ISO 3888-1): lateral offset between the right borders of the second lane and the others."""
CONES_OF_A_BORDER = 3
"""At the beginning, the middle and the end of a lane."""


@dataclasses.dataclass(frozen=True)
class Lane:
    """A lane: x of its start and end, y of its right and left border (m)."""

    start: float
    end: float
    right: float
    left: float

    @property
    def middle(self) -> float:
        return (self.right + self.left) / 2


@dataclasses.dataclass(frozen=True)
class Track:
    """Three lanes in driving order; side: 1, or -1 for the mirrored track."""

    lanes: tuple[Lane, Lane, Lane]
    side: float = 1.0

    @property
    def end(self) -> float:
        return self.lanes[-1].end

    @property
    def cones(self) -> np.ndarray:
        """Points (n, 2) (m) on the lane borders, touched from outside by the bases of the cones."""
        places = [
            (x, self.side * border)
            for lane in self.lanes
            for x in np.linspace(lane.start, lane.end, CONES_OF_A_BORDER).tolist()
            for border in (lane.left, lane.right)
        ]
        return np.array(places)

    def missed_lanes(self, x: np.ndarray, y: np.ndarray) -> list[bool]:
        """For each lane, whether a point (x, y) (m) alongside it is outside its borders."""
        y = self.side * y
        return [
            bool(np.any((x >= lane.start) & (x <= lane.end) & ((y < lane.right) | (y > lane.left))))
            for lane in self.lanes
        ]

    def path(self, x: np.ndarray) -> np.ndarray:
        """y (n,) of the path at `x` (n,) (m).

        The path follows the centre of each lane. Between two lanes it is the polynomial
        s = 10 t^3 - 15 t^4 + 6 t^5, t = 0 ... 1, whose direction and curvature are continuous. It
        is straight before and after the track.
        """
        first = self.lanes[0]
        y = np.full(np.shape(x), first.middle)
        for before, after in zip(self.lanes, self.lanes[1:], strict=False):
            t = np.clip((x - before.end) / (after.start - before.end), 0.0, 1.0)
            y += (after.middle - before.middle) * t**3 * (10 - 15 * t + 6 * t**2)
        return self.side * y


def obstacle_avoidance_track(width: float, side: float = 1.0) -> Track:
    """ISO 3888-2 for a vehicle of that width (m): 12, 13.5, 11, 12.5 and 12 m, 61 m in total.

    The borders of the first and last lane that face the second lane are collinear.
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
    """ISO 3888-1 for a vehicle of that width (m): 15, 30, 25, 25, 15 and 15 m, 125 m in total.

    The last two sections form one lane. The right borders of the first and last lane are collinear.
    """
    right = -(1.1 * width + 0.25) / 2
    beyond = right + LANE_OFFSET
    lanes = (
        Lane(0.0, 15.0, right, -right),
        Lane(45.0, 70.0, beyond, beyond + 1.2 * width + 0.25),
        Lane(95.0, 125.0, right, right + 1.3 * width + 0.25),
    )
    return Track(lanes, side)
