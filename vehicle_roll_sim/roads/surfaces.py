"""Features that change the friction or the softness of a road, not its height."""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.model.road.layout import CHESSBOARD, PATCH, SOIL
from vehicle_roll_sim.roads.feature import Rectangle, Row, edge, size

LARGEST_FRICTION = 10.0
MOST_SQUARES = 1000
"""Largest number of squares in either direction whose edges are shown in pictures."""


def factor(description: str):
    """Declare a factor of friction."""
    return parameter(description, "", 0.0, LARGEST_FRICTION)


def _check_sides(rectangle: Rectangle) -> None:
    _, right, left = rectangle.bounds
    if not right < left:
        allowed = f"less than left, {left:g} m"
        raise InputError("right", rectangle.right, allowed)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Patch(Rectangle):
    """A rectangle with friction of its own, such as one half of a split-friction road."""

    friction: float = factor("factor on LMUX and LMUY of the tires")

    def __post_init__(self):
        super().__post_init__()
        _check_sides(self)

    def rows(self) -> list[Row]:
        return [self.row(PATCH, *self.bounds, self.friction)]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Chessboard(Rectangle):
    """Squares of two frictions, alternating along and across."""

    friction: float = factor("factor on LMUX and LMUY on the first square, at the right edge")
    other_friction: float = factor("the same on the adjacent squares")
    square_length: float = size("length of a square", least=0.01)
    square_width: float = size("width of a square", least=0.01)

    def __post_init__(self):
        super().__post_init__()
        for name in ("left", "right"):
            if getattr(self, name) is None:
                raise InputError(name, None, "a number in m: squares are counted from the right")
        _check_sides(self)

    def rows(self) -> list[Row]:
        squares = (self.square_length, self.square_width)
        frictions = (self.friction, self.other_friction)
        return [self.row(CHESSBOARD, *self.bounds, *frictions, *squares)]

    def edges(self) -> tuple[Sequence[float], Sequence[float]]:
        length, right, left = self.bounds
        along = self.square_length * np.arange(MOST_SQUARES)
        across = right + self.square_width * np.arange(MOST_SQUARES)
        return (*along[along < length], length), (*across[across < left], left)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Soil:
    """Properties of soft soil: how far wheels sink in, and the lateral resistance of furrows.

    A wheel sinks by its load over the stiffness. The furrow resists a wheel that slides sideways
    with Rankine's passive earth pressure over the length of the contact patch,

        F = L (2 C sqrt(K) z + gamma K z^2 / 2),  K = tan(45 deg + phi / 2)^2.
    """

    stiffness: float = parameter("wheel load per unit of sinkage", "N/m", 1e3, 1e9, default=1e5)
    cohesion: float = parameter("cohesion of the soil, C", "Pa", 0.0, 1e7, default=5e3)
    friction_angle: float = parameter(
        "angle of internal friction of the soil, phi", "deg", 0.0, 60.0, default=30.0
    )
    unit_weight: float = parameter(
        "unit weight of the soil, gamma", "N/m^3", 0.0, 1e5, default=1.6e4
    )
    contact_length: float = parameter("length of the contact patch, L", "m", 0.01, 2.0, default=0.2)

    @property
    def resistances(self) -> tuple[float, float]:
        """Coefficients of z and z^2 in the force on a wheel (N/m, N/m^2)."""
        passive = math.tan(math.pi / 4 + math.radians(self.friction_angle) / 2) ** 2
        linear = 2 * self.contact_length * self.cohesion * math.sqrt(passive)
        return linear, self.contact_length * self.unit_weight * passive / 2

    def soil_values(self) -> dict[str, float]:
        """Its values by name."""
        return {field.name: getattr(self, field.name) for field in dataclasses.fields(Soil)}


@dataclasses.dataclass(frozen=True, kw_only=True)
class SoftSoil(Soil, Rectangle):
    """Soil into which wheels sink, and whose furrows resist them sideways."""

    rounding: float = edge(default=0.5)

    def __post_init__(self):
        super().__post_init__()
        _check_sides(self)

    def rows(self) -> list[Row]:
        return [
            self.row(SOIL, *self.bounds, 1.0 / self.stiffness, *self.resistances, self.rounding)
        ]
