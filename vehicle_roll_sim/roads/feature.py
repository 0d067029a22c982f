"""What all features of a road have in common."""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.declaration import keep_validated, parameter

FURTHEST = 1e5
"""m"""
HIGHEST = 1e3
"""m: of the heights in a table."""
MOST_POINTS = 200_000
"""Of a track, and of a grid."""
Row = tuple[int, list[float], np.ndarray | None]
"""A feature for `model.road.layout.ground_of`: kind, numbers and table."""
UNBOUNDED = "unbounded"
SHOWN = 200.0
"""m: length of a feature that is shown in a picture that does not follow a vehicle."""


def place(description: str, **settings):
    """Declare a place or a distance in m."""
    return parameter(description, "m", -FURTHEST, FURTHEST, **settings)


def size(description: str, **settings):
    """Declare a length in m."""
    return parameter(description, "m", settings.pop("least", 1e-3), FURTHEST, **settings)


def edge(**settings):
    """Declare the length over which the edges of a feature are rounded."""
    about = "length over which its edges are rounded, as by the contact patch of a tire"
    return parameter(about, "m", 0.01, 10.0, **{"default": 0.1} | settings)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Feature:
    """A part of a road in its own coordinates from its start: s along it and n to the left.

    Raises InputError for a value that is not allowed.
    """

    start: float = place("distance to its start, along the initial heading")
    offset: float = place("where it begins, to the left of the initial heading", default=0.0)
    heading: float = parameter(
        "direction of its s axis, counterclockwise from the initial heading",
        "deg",
        -360.0,
        360.0,
        default=0.0,
    )

    def __post_init__(self):
        keep_validated(self)

    def row(self, kind: int, *numbers: float, table: np.ndarray | None = None) -> Row:
        """A row with this feature's origin and heading, and its own numbers."""
        angle = math.radians(self.heading)
        return kind, [self.start, self.offset, math.cos(angle), math.sin(angle), *numbers], table

    def rows(self) -> list[Row]:
        """The rows of the ground that it consists of."""
        raise NotImplementedError

    def edges(self) -> tuple[Sequence[float], Sequence[float]]:
        """Its edges (m), for pictures: the s of those across it, and the n of those along it."""
        return (0.0,), ()

    def placed(self, points: np.ndarray) -> np.ndarray:
        """Points s, n of the feature in the ground frame, shape (n, 2) (m)."""
        _, (x, y, c, s), _ = Feature.row(self, 0)  # some rows begin elsewhere
        return points @ np.array([[c, s], [-s, c]]) + (x, y)

    def course(self) -> np.ndarray:
        """Points along its middle in the ground frame, shape (n, 2) (m); at most `SHOWN` long."""
        along, across = self.edges()
        sides = [n for n in across if math.isfinite(n)] or [0.0]
        first, last = min(along), min(max(along), min(along) + SHOWN)
        s = np.linspace(first, last, max(math.ceil(last - first), 1) + 1)
        return self.placed(np.column_stack((s, np.full_like(s, (min(sides) + max(sides)) / 2))))


@dataclasses.dataclass(frozen=True, kw_only=True)
class Rectangle(Feature):
    """A feature that is bounded by a rectangle."""

    length: float | None = size("length along its heading", default=None, none=UNBOUNDED)
    left: float | None = place("lateral position n of its left edge", default=None, none=UNBOUNDED)
    right: float | None = place(
        "lateral position n of its right edge", default=None, none=UNBOUNDED
    )

    @property
    def bounds(self) -> tuple[float, float, float]:
        """Length, right and left edge (m), infinite if they are not given."""
        given = zip((self.length, self.right, self.left), (1, -1, 1), strict=True)
        return tuple(sign * math.inf if value is None else value for value, sign in given)

    def edges(self) -> tuple[Sequence[float], Sequence[float]]:
        length, *sides = self.bounds
        return (0.0, length), sides
