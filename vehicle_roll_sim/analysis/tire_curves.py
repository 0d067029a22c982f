"""Tire behaviour over slip: curves, stiffnesses and peak friction under given conditions."""

import dataclasses
import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.vehicle.tire_evaluation import TireForces, evaluate
from vehicle_roll_sim.vehicle.tire_file import Tire

WIDEST_SLIP_RATIO, WIDEST_SLIP_ANGLE = 1.0, math.radians(20)
"""Curves end here (-, rad)."""
POINTS = 201
"""Number of points of a curve; odd, so that zero slip is one of them."""
RINGS, RAYS = 41, 61
"""Number of slip angles and slip ratios whose forces the combined-slip envelope encloses."""
SLIGHT = 1e-6
"""Slip (- and rad) for central differences; their relative error is below 1e-8."""
SHARES_OF_NOMINAL = (0.5, 1.0, 1.5, 2.0)
"""Default loads relative to the nominal load."""


@dataclasses.dataclass(frozen=True)
class Condition:
    """All inputs other than slip: load (N), inclination (rad), pressure (Pa; None for that of the
    file), speed (m/s), and side of the vehicle."""

    normal_force: float
    inclination: float
    pressure: float | None
    speed: float
    side: str

    def forces(self, tire: Tire, slip_ratio, slip_angle) -> TireForces:
        """Forces, moments and radii at these slips (-, rad), which are broadcast."""
        slips = np.broadcast_arrays(*np.atleast_1d(slip_ratio, slip_angle))
        return evaluate(
            tire,
            self.normal_force,
            *slips,
            inclination=self.inclination,
            pressure=self.pressure,
            speed=self.speed,
            side=self.side,
        )


class Curve(NamedTuple):
    """One curve: its name, its condition, slips (-, rad) and forces, each of shape (n,)."""

    name: str
    condition: Condition
    slip_ratio: np.ndarray
    slip_angle: np.ndarray
    forces: TireForces


class Figures(NamedTuple):
    """Slopes at zero slip (N, N/rad), positive for a tire that opposes slip, and peak force over
    load (-): braking, driving, and lateral at positive and negative slip angles."""

    slip_stiffness: float
    cornering_stiffness: float
    braking: float
    driving: float
    positive_angle: float
    negative_angle: float


def conditions(
    tire: Tire, loads: Sequence[float], inclinations: Sequence[float], pressures: Sequence
) -> list[Condition]:
    """Every combination of these, at the speed of the file, on the side for which it was made.

    Without loads (N), they are SHARES_OF_NOMINAL of the nominal load.
    """
    loads = loads or [share * tire.coefficients["FNOMIN"] for share in SHARES_OF_NOMINAL]
    side = "right" if tire.side == "right" else "left"
    cases = itertools.product(loads, inclinations or [0.0], pressures or [None])
    return [Condition(*case, reference_speed(tire), side) for case in cases]


def reference_speed(tire: Tire) -> float:
    """LONGVL, the speed of the measurements (m/s); 16.7 if the file gives none."""
    return tire.coefficients["LONGVL"]


def figures(tire: Tire, condition: Condition) -> Figures:
    """Stiffnesses and peak friction in pure slip."""
    either = np.array([-SLIGHT, SLIGHT])
    ahead = condition.forces(tire, either, 0.0).longitudinal_force
    aside = condition.forces(tire, 0.0, either).lateral_force
    longitudinal = longitudinal_curve(tire, condition).forces.longitudinal_force
    lateral = lateral_curve(tire, condition)
    is_positive = lateral.slip_angle > 0.0
    forces = lateral.forces.lateral_force
    largest = (-longitudinal, longitudinal, -forces[is_positive], forces[~is_positive])
    peaks = (float(each.max()) / condition.normal_force for each in largest)
    return Figures(_slope(ahead), -_slope(aside), *peaks)


def _slope(forces: np.ndarray) -> float:
    return float(forces[1] - forces[0]) / (2 * SLIGHT)


def longitudinal_curve(tire: Tire, condition: Condition) -> Curve:
    """Forces over slip ratio at zero slip angle."""
    return _curve("longitudinal", tire, condition, _even(WIDEST_SLIP_RATIO), 0.0)


def lateral_curve(tire: Tire, condition: Condition) -> Curve:
    """Forces over slip angle at zero slip ratio."""
    return _curve("lateral", tire, condition, 0.0, _even(WIDEST_SLIP_ANGLE))


def outline(tire: Tire, condition: Condition) -> Curve:
    """The convex hull of the forces at all slips, counter-clockwise.

    The first corner is repeated at the end.
    """
    grid = np.meshgrid(_denser(WIDEST_SLIP_RATIO, RAYS), _denser(WIDEST_SLIP_ANGLE, RINGS))
    none, (ratios, angles) = np.zeros(POINTS), (axis.ravel() for axis in grid)
    slip_ratio = np.concatenate([ratios, _even(WIDEST_SLIP_RATIO), none])  # and those of the curves
    slip_angle = np.concatenate([angles, none, _even(WIDEST_SLIP_ANGLE)])
    forces = condition.forces(tire, slip_ratio, slip_angle)
    corners = _hull(forces.longitudinal_force, forces.lateral_force)
    chosen = TireForces(*(values[corners] for values in forces))
    return Curve("outline", condition, slip_ratio[corners], slip_angle[corners], chosen)


class CurveSet(NamedTuple):
    """All curves of the figure under one condition."""

    longitudinal: Curve
    lateral: Curve
    outline: Curve

    @property
    def condition(self) -> Condition:
        return self.outline.condition


def curves_of(tire: Tire, conditions: Sequence[Condition]) -> list[CurveSet]:
    """The curves of the figure under each condition."""
    kinds = longitudinal_curve, lateral_curve, outline
    return [CurveSet(*(kind(tire, each) for kind in kinds)) for each in conditions]


def _even(widest: float) -> np.ndarray:
    """Evenly spaced slips from -widest to widest, including zero, shape (POINTS,)."""
    return np.linspace(-widest, widest, POINTS)


def _denser(widest: float, count: int) -> np.ndarray:
    """Slips from -widest to widest, denser towards zero, shape (count,)."""
    steps = np.linspace(-1.0, 1.0, count)
    return widest * steps * np.abs(steps)


def _curve(name: str, tire: Tire, condition: Condition, slip_ratio, slip_angle) -> Curve:
    slips = np.broadcast_arrays(*np.atleast_1d(slip_ratio, slip_angle))
    return Curve(name, condition, *slips, condition.forces(tire, *slips))


def _hull(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Indices of the corners of the convex hull of points, by Andrew's monotone chain."""
    order = np.lexsort((y, x)).tolist()
    lower, upper = _half_hull(x, y, order), _half_hull(x, y, order[::-1])
    return np.array([*lower, *upper[1:]])


def _half_hull(x: np.ndarray, y: np.ndarray, order: list[int]) -> list[int]:
    """One side of the hull, from the first to the last of `order`: a path that only turns left."""
    corners: list[int] = []
    for point in order:
        while len(corners) > 1 and not _turns_left(x, y, *corners[-2:], point):
            corners.pop()
        corners.append(point)
    return corners


def _turns_left(x: np.ndarray, y: np.ndarray, a: int, b: int, c: int) -> bool:
    return (x[b] - x[a]) * (y[c] - y[a]) > (y[b] - y[a]) * (x[c] - x[a])
