"""Features with a height that a formula gives: ramps, crests and dips, curbs and banked curves."""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.model.road.banked_curve import advanced
from vehicle_roll_sim.model.road.layout import BANKED_CURVE, RAMP, WALL, WAVE
from vehicle_roll_sim.roads.feature import Feature, Rectangle, Row, edge, size

LEFT, RIGHT = "left", "right"
POINT_SPACING = 1.0
"""m between points on the centreline of a curve."""
MOST_POINTS = 20_000


@dataclasses.dataclass(frozen=True, kw_only=True)
class Ramp(Rectangle):
    """A ramp: up along its length, level for a while, and down again or a drop."""

    length: float = size("length of the rise")
    height: float = parameter("height of its top; negative for a descent", "m", -100.0, 100.0)
    top: float | None = size("length of its level top", least=0.0, default=None, none="no end")
    descent: float | None = size(
        "length of the descent after the top", default=None, none="a drop over the rounding"
    )
    rounding: float = edge()

    def rows(self) -> list[Row]:
        _, right, left = self.bounds
        top = math.inf if self.top is None else self.top
        down = self.rounding if self.descent is None else self.descent
        rise = (self.length, self.height, top, down)
        return [self.row(RAMP, *rise, right, self.rounding, left, self.rounding, self.rounding)]

    def edges(self) -> tuple[Sequence[float], Sequence[float]]:
        _, right, left = self.bounds
        end = self.length + (math.inf if self.top is None else self.top)
        along = (0.0, self.length, end, end + (self.descent or self.rounding))
        return along, (right, right + self.rounding, left, left + self.rounding)


@dataclasses.dataclass(frozen=True, kw_only=True)
class CorkscrewRamp(Feature):
    """A ramp that only the wheels of one side drive up: it rises along and to its raised side."""

    length: float = size("length of the rise")
    height: float = parameter("height of the raised edge at its end", "m", 0.001, 10.0)
    width: float = size("distance from its low edge, at n = 0, to its raised edge")
    raised: str = parameter("the side that is raised", choices=(LEFT, RIGHT), default=LEFT)
    top: float = size(
        "length of its level part after the rise, before the drop", least=0.0, default=0.0
    )
    rounding: float = edge()

    def rows(self) -> list[Row]:
        rise = (self.length, self.height, self.top, self.rounding)
        if self.raised == LEFT:
            across = (0.0, self.width, math.inf, self.rounding)
        else:
            across = (-math.inf, self.rounding, -self.width, self.width)
        return [self.row(RAMP, *rise, *across, self.rounding)]

    def edges(self) -> tuple[Sequence[float], Sequence[float]]:
        end = self.length + self.top
        side = self.width if self.raised == LEFT else -self.width
        return (0.0, self.length, end, end + self.rounding), (0.0, side)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Wave(Feature):
    """Crests (positive height) or dips (negative) over the whole width: h / 2 (1 - cos)."""

    length: float = size("length of one crest or dip", least=0.1)
    height: float = parameter("height of a crest, negative for a dip", "m", -100.0, 100.0)
    count: float = parameter("number of crests or dips in a row", "", 1.0, 1e5, default=1.0)

    def __post_init__(self):
        super().__post_init__()
        if self.count != round(self.count):
            raise InputError("count", self.count, "a whole number")

    def rows(self) -> list[Row]:
        return [self.row(WAVE, self.length, self.height, self.count)]

    def edges(self) -> tuple[Sequence[float], Sequence[float]]:
        return (0.0, self.length * self.count), ()


@dataclasses.dataclass(frozen=True, kw_only=True)
class Curb(Feature):
    """A curb along its heading: a step with an inclined face, which also pushes on sidewalls.

    The face begins at n = 0 and rises to one side. A tire whose sidewall comes into contact with
    it is pushed back by a spring and a damper; see `model.road.resistance`. Wheels and rims do not
    touch the road.
    """

    length: float = size("length of the curb", default=1000.0)
    height: float = parameter("height of its top above the road", "m", 0.01, 1.0, default=0.15)
    raised: str = parameter("the side that is raised", choices=(LEFT, RIGHT), default=LEFT)
    face_angle: float = parameter(
        "angle between its face and the road", "deg", 10.0, 90.0, default=75.0
    )
    side_distance: float = parameter(
        "distance from the wheel plane to the sidewall of the tire", "m", 0.01, 1.0, default=0.1
    )
    stiffness: float = parameter(
        "stiffness of a sidewall that the face presses against the rim",
        "N/m",
        0.0,
        1e8,
        default=1e6,
    )
    damping: float = parameter(
        "damping of a sidewall that the face presses against the rim",
        "N s/m",
        0.0,
        1e6,
        default=2e3,
    )
    rounding: float = edge()

    def __post_init__(self):
        super().__post_init__()
        if self.length < 4 * self.rounding:
            allowed = f"at least four times its rounding, {4 * self.rounding:g} m"
            raise InputError("length", self.length, allowed)

    @property
    def face(self) -> float:
        """Width of the face with its rounding (m)."""
        return self.height / math.tan(math.radians(self.face_angle)) + self.rounding

    def edges(self) -> tuple[Sequence[float], Sequence[float]]:
        ends = (0.0, self.rounding, self.length - self.rounding, self.length)
        return ends, (0.0, self.face if self.raised == LEFT else -self.face)

    def rows(self) -> list[Row]:
        face = self.face
        rise = (self.rounding, self.height, self.length - 2 * self.rounding, self.rounding)
        tire = (self.side_distance, self.stiffness, self.damping)
        wall = (self.length, self.height, *tire, self.rounding, face)
        if self.raised == LEFT:
            across, facing = (0.0, face, math.inf, self.rounding), self
        else:  # seen from its other end, the low side is on the right again
            across = (-math.inf, self.rounding, -face, face)
            facing = self._turned()
        return [self.row(RAMP, *rise, *across, self.rounding), facing.row(WALL, *wall)]

    def _turned(self) -> "Curb":
        angle = math.radians(self.heading)
        turned = self.heading - math.copysign(180.0, self.heading)
        x, y = self.length * math.cos(angle), self.length * math.sin(angle)
        return dataclasses.replace(
            self, start=self.start + x, offset=self.offset + y, heading=turned
        )


@dataclasses.dataclass(frozen=True, kw_only=True)
class BankedCurve(Feature):
    """A curve between two straight roads: a clothoid, an arc of constant radius, and a clothoid.

    The bank grows along the first clothoid and ends with the second; the centreline is level.
    """

    radius: float = parameter("radius of the arc, negative to the right", "m", -1e5, 1e5)
    arc: float = size("length of the arc along the centreline")
    transition: float = size("length of each clothoid", least=1.0, default=50.0)
    bank: float = parameter(
        "cross slope in the arc, positive with the outer side raised", "m/m", -1.0, 1.0
    )
    width: float = size("width of the road; beyond it, the edge height continues", default=12.0)
    rounding: float = edge(default=5.0)

    def __post_init__(self):
        super().__post_init__()
        if abs(self.radius) < self.width:
            allowed = f"at least the width of the road, {self.width:g} m, to either side"
            raise InputError("radius", self.radius, allowed)

    def rows(self) -> list[Row]:
        shape = (self.transition, self.arc, 1.0 / self.radius)
        count = math.ceil((2 * self.transition + self.arc) / POINT_SPACING) + 1
        if count > MOST_POINTS:
            raise InputError("arc", self.arc, f"a curve of at most {MOST_POINTS} m")
        points = np.zeros((count, 2))
        for k in range(1, count):
            x, y = points[k - 1]
            points[k] = advanced(x, y, POINT_SPACING * (k - 1), POINT_SPACING, *shape)
        own = (count, POINT_SPACING, *shape, self.bank, self.width / 2, self.rounding)
        return [self.row(BANKED_CURVE, *own, table=points.ravel())]

    def course(self) -> np.ndarray:
        ((_, _, centreline),) = self.rows()
        return self.placed(centreline.reshape(-1, 2))
