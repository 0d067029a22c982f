"""Masses of a vehicle: its sprung part from data of the whole, and with payload (docs/masses.md).

Places count from the point on the road below the middle of the front axle: x forward, y left, z
up. A tensor of inertia has the moments Jx, Jy, Jz on its diagonal and minus the products Jxy, Jxz,
Jyz (integrals of x y dm and so on) beside it.
"""

import dataclasses
from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.declaration import InputError, keep_validated, parameter

_PLACE = {"unit": "m", "minimum": -50.0, "maximum": 50.0}
_OWN_INERTIA = {"unit": "kg m^2", "minimum": 0.0, "maximum": 1e7, "default": 0.0}
MOMENTS = ("roll_inertia", "pitch_inertia", "yaw_inertia")
PRODUCTS = {"roll_pitch_product": (0, 1), "roll_yaw_product": (0, 2), "pitch_yaw_product": (1, 2)}
"""Products of inertia, and their place in the tensor."""


@dataclasses.dataclass(frozen=True)
class Load:
    """One mass of the payload. Raises InputError for a value that is not allowed."""

    mass: float = parameter("mass", "kg", 0.001, 1e6)
    behind_front_axle: float = parameter("distance of its c.g. behind the front axle", **_PLACE)
    height: float = parameter(
        "height of its c.g. above ground, before it loads the springs", **_PLACE
    )
    left_of_middle: float = parameter(
        "distance of its c.g. to the left of the centreline", **_PLACE, default=0.0
    )
    roll_inertia: float = parameter("its own moment of inertia about x", **_OWN_INERTIA)
    pitch_inertia: float = parameter("its own moment of inertia about y", **_OWN_INERTIA)
    yaw_inertia: float = parameter("its own moment of inertia about z", **_OWN_INERTIA)

    def __post_init__(self):
        keep_validated(self)
        moments = [getattr(self, name) for name in MOMENTS]
        for name, moment in zip(MOMENTS, moments, strict=True):
            if moment > (most := sum(moments) - moment):
                allowed = f"at most the sum of its other two moments of inertia, {most:g} kg m^2"
                raise InputError(name, moment, allowed)

    @property
    def body(self) -> "Body":
        place = (-self.behind_front_axle, self.left_of_middle, self.height)
        return Body(self.mass, np.array(place), np.diag([getattr(self, n) for n in MOMENTS]))


class Body(NamedTuple):
    """A rigid body: mass (kg), place of its c.g., shape (3,) (m), and tensor of inertia about it,
    shape (3, 3) (kg m^2). A negative mass takes a part away."""

    mass: float
    place: np.ndarray
    inertia: np.ndarray

    def without(self, parts: Iterable["Body"]) -> "Body":
        """What is left of it without these parts."""
        return joined([self, *(Body(-mass, place, -inertia) for mass, place, inertia in parts)])


def point(mass: float, place) -> Body:
    """A body without extent, at a place, shape (3,) (m)."""
    return Body(mass, np.array(place), np.zeros((3, 3)))


def joined(bodies: Iterable[Body]) -> Body:
    """Bodies as one: sum of masses, c.g., and tensors shifted to it by the parallel-axis theorem.

    J = sum of J_i + m_i (d_i.d_i 1 - d_i d_i), with d_i from the common c.g. to that of body i.
    """
    bodies = list(bodies)
    mass = float(np.sum([body.mass for body in bodies]))
    place = np.sum([body.mass * body.place for body in bodies], axis=0) / mass
    inertia = np.zeros((3, 3))
    for body in bodies:
        away = body.place - place
        inertia += body.inertia + body.mass * (away @ away * np.eye(3) - np.outer(away, away))
    return Body(mass, place, inertia)


def tensor(values: Mapping[str, float]) -> np.ndarray:
    """The tensor of inertia, shape (3, 3) (kg m^2), from moments and products by name."""
    inertia = np.diag([values[name] for name in MOMENTS])
    for name, (row, column) in PRODUCTS.items():
        inertia[row, column] = inertia[column, row] = -values[name]
    return inertia


def numbers_of(inertia: np.ndarray) -> dict[str, float]:
    """Moments and products by name, from a tensor of inertia."""
    moments = dict(zip(MOMENTS, np.diag(inertia).tolist(), strict=True))
    return moments | {name: 0.0 - float(inertia[at]) for name, at in PRODUCTS.items()}
