"""Springs, dampers, stops and steering geometry: from parameters to the record DETAILS."""

import dataclasses
import functools

import numpy as np

from vehicle_roll_sim.model.equilibrium import static_suspension_compression
from vehicle_roll_sim.model.records import DETAILS, LR, STOPS, WHEEL_COUNT
from vehicle_roll_sim.model.work_space import COEFFICIENTS
from vehicle_roll_sim.vehicle.suspension_parameters import (
    AXLES,
    COMPLIANCE_CAMBER,
    OF_COMPLIANCE,
    OF_STRUTS,
)
from vehicle_roll_sim.vehicle.travel_curves import TravelCurve, tabulated

FINEST = 4 * np.finfo(float).eps
"""Tolerance of a static compression: m, and relative."""
SLOW = 1e-9
"""m/s: below which the damping of a linear model is meant."""
PERCENT = 0.01
DERIVED = ("ackermann", "spring_compression_at_rest")
OF_AXLES = tuple(
    name for name in DETAILS.names if DETAILS[name].shape == (WHEEL_COUNT,) and name not in DERIVED
)
"""Fields that take the parameter of their name."""


class TwoSlopes:
    """A force that is proportional to its argument, with one slope below 0 and another above."""

    def __init__(self, below: float, above: float):
        self.knots = np.zeros(1)
        self._slopes = below, above
        self.key = np.array([below, above]).tobytes()

    def piece(self, origin: float, inside: float) -> np.ndarray:
        """Coefficients, lowest power first, as those of a TravelCurve."""
        slope = self._slopes[int(inside >= 0.0)]
        return np.array([slope * origin, slope, *[0.0] * (COEFFICIENTS - 2)])


def force_and_slope(curve: TravelCurve | TwoSlopes, x: float) -> tuple[float, float]:
    """The value of a curve at x, and its slope."""
    force, slope, *_ = curve.piece(x, x)
    return float(force), float(slope)


def spring_of(vehicle, axle: str) -> TravelCurve:
    """Force of one spring of an axle (N) over its compression (m)."""
    table = getattr(vehicle, f"{axle}_spring_force")
    if table is None:
        return TravelCurve(getattr(vehicle, f"{axle}_spring_stiffness"))
    return TravelCurve(table, is_change=False)


def damper_of(vehicle, axle: str) -> TravelCurve | TwoSlopes:
    """Force of one damper of an axle (N) over the velocity of compression (m/s)."""
    table = getattr(vehicle, f"{axle}_damper_force")
    if table is not None:
        return TravelCurve(table, is_change=False)
    bump = getattr(vehicle, f"{axle}_damping")
    rebound = getattr(vehicle, f"{axle}_rebound_damping")
    return TwoSlopes(bump if rebound is None else rebound, bump)


def mean_damping(vehicle, axle: str) -> float:
    """The damping coefficient of linear models (N s/m): the mean of bump and rebound, if slow."""
    damper = damper_of(vehicle, axle)
    mean = (force_and_slope(damper, SLOW)[1] + force_and_slope(damper, -SLOW)[1]) / 2
    return mean * ratio_at_rest(vehicle, axle, "damper") ** 2


def travel_of(vehicle, axle: str, part: str) -> TravelCurve:
    """Compression since rest (m) of a spring or damper over the travel of its wheel (m)."""
    ratio = getattr(vehicle, f"{axle}_{part}_motion_ratio")
    return TravelCurve(1.0 if ratio is None else ratio)


def spring_travel_of(vehicle, axle: str) -> TravelCurve:
    """Compression of a spring since rest (m) over the travel of its wheel (m)."""
    return travel_of(vehicle, axle, "spring")


def damper_travel_of(vehicle, axle: str) -> TravelCurve:
    """Compression of a damper since rest (m) over the travel of its wheel (m)."""
    return travel_of(vehicle, axle, "damper")


def ratio_at_rest(vehicle, axle: str, part: str) -> float:
    """Motion ratio of a spring or damper at travel 0."""
    return force_and_slope(travel_of(vehicle, axle, part), 0.0)[1]


def with_linear_dampers(vehicle):
    """The vehicle with mean damping coefficients where bump and rebound have one each.

    A linear model has one coefficient, and at rest a damper is neither in bump nor in rebound.
    """
    changed = {}
    for axle in AXLES:
        bump, rebound = (getattr(vehicle, f"{axle}_{n}") for n in ("damping", "rebound_damping"))
        if rebound is not None:
            changed[f"{axle}_damping"] = (bump + rebound) / 2
            changed[f"{axle}_rebound_damping"] = None
    return dataclasses.replace(vehicle, **changed)


def compression_under(spring: TravelCurve, load: float) -> float:
    """The compression (m) at which a rising spring force carries a load (N)."""
    first, last = (float(end) for end in spring.knots[[0, -1]])
    (lowest, before), (highest, beyond) = (force_and_slope(spring, end) for end in (first, last))
    if load <= lowest:
        return first + (load - lowest) / before
    if load >= highest:
        return last + (load - highest) / beyond
    from scipy.optimize import brentq  # slow to import, and for tables only

    return brentq(
        lambda x: force_and_slope(spring, x)[0] - load, first, last, xtol=FINEST, rtol=FINEST
    )


def spring_compressions_at_rest(vehicle, gravity: float) -> np.ndarray:
    """Compression of each spring, shape (4,) (m; eq. 19 with the motion ratio); gravity: m/s^2."""
    found, mass = [], vehicle.sprung_mass
    for axle, wheel in AXLES.items():
        share = vehicle.axle_load_share[wheel : wheel + WHEEL_COUNT // 2]
        share = share / ratio_at_rest(vehicle, axle, "spring")
        stiffness = getattr(vehicle, f"{axle}_spring_stiffness")
        if stiffness is not None:
            found += [*static_suspension_compression(mass, share, stiffness, gravity)]
        else:
            spring = spring_of(vehicle, axle)
            found += [compression_under(spring, mass * gravity * each) for each in share]
    return np.array(found)


def compressions_at_rest(vehicle, gravity: float) -> np.ndarray:
    """xsi of each corner, shape (4,) (m; eq. 19): those of the springs over their motion ratios."""
    ratios = [ratio_at_rest(vehicle, axle, "spring") for axle in AXLES]
    return spring_compressions_at_rest(vehicle, gravity) / np.repeat(ratios, WHEEL_COUNT // 2)


def stiffnesses_at_rest(vehicle, gravity: float) -> np.ndarray:
    """Slope of the spring force on each wheel over its travel at rest, shape (4,) (N/m).

    k m^2 + F m' with the stiffness k and force F of the spring and its motion ratio m.
    """
    found = []
    for i, compression in enumerate(spring_compressions_at_rest(vehicle, gravity)):
        axle = "front" if i < LR else "rear"
        force, stiffness = force_and_slope(spring_of(vehicle, axle), compression)
        _, ratio, half_change, *_ = spring_travel_of(vehicle, axle).piece(0.0, 0.0)
        found.append(stiffness * ratio**2 + force * 2 * half_change)
    return np.array(found)


def toe_change_of(vehicle, axle: str) -> TravelCurve:
    """Angle of a left wheel (rad, to the left) over its travel (m)."""
    return vehicle.travel_curves[axle][f"{axle}_toe_change"]


CURVES = {
    "spring": spring_of,
    "damper": damper_of,
    "toe_change": toe_change_of,
    "spring_travel": spring_travel_of,
    "damper_travel": damper_travel_of,
}
"""By the names DETAIL_CURVES of the fields."""


def has_any(vehicle, names: tuple[str, ...]) -> bool:
    """Whether one of these parameters of an axle is given."""
    return any(getattr(vehicle, name) is not None for name in _of_both_axles(names))


@functools.cache
def _of_both_axles(names: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(f"{axle}_{name}" for axle in AXLES for name in names)


def details_of(vehicle, gravity: float) -> np.ndarray:
    """One DETAILS record, shape (1,); gravity: m/s^2."""
    record = np.zeros(1, DETAILS)
    details = record[0]
    details["struts"] = has_any(vehicle, OF_STRUTS)
    details["compliance"] = has_any(vehicle, OF_COMPLIANCE)
    details["camber_yields"] = has_any(vehicle, (COMPLIANCE_CAMBER,))
    for name in OF_AXLES:
        front, rear = (getattr(vehicle, f"{axle}_{name}") or 0.0 for axle in AXLES)
        details[name] = front, front, rear, rear
    for axle, wheel in AXLES.items():
        both = slice(wheel, wheel + WHEEL_COUNT // 2)
        for stop in STOPS:
            if getattr(vehicle, f"{axle}_{stop}_clearance") is None:
                details[f"{stop}_clearance"][both] = np.inf
    for name, curve in CURVES.items():
        parts = zip(*(tabulated([curve(vehicle, axle)]) for axle in AXLES), strict=True)
        knots, origins, pieces = map(np.array, parts)
        details[f"{name}_knots"], details[f"{name}_origins"] = knots, origins
        details[name] = pieces[..., 0]
    details["spring_compression_at_rest"] = spring_compressions_at_rest(vehicle, gravity)
    details["toe"] *= (-1, 1, -1, 1)
    share = PERCENT * (vehicle.ackermann_percentage or 0.0) * vehicle.front_track / 2
    share /= vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    details["ackermann"][:LR] = share, -share
    return record
