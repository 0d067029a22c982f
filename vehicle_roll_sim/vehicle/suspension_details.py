"""Springs, dampers, stops and steering geometry: from parameters to the record DETAILS."""

import dataclasses

import numpy as np
from scipy.optimize import brentq

from vehicle_roll_sim.model.equilibrium import static_suspension_compression
from vehicle_roll_sim.model.records import (
    COEFFICIENTS,
    DETAIL_CURVES,
    DETAILS,
    LR,
    STOPS,
    WHEEL_COUNT,
)
from vehicle_roll_sim.vehicle.suspension_parameters import AXLES, OF_COMPLIANCE, OF_STRUTS
from vehicle_roll_sim.vehicle.travel_curves import TravelCurve, tabulated

FINEST = 4 * np.finfo(float).eps
"""Tolerance of a static compression: m, and relative."""
SLOW = 1e-9
"""m/s: below which the damping of a linear model is meant."""
PERCENT = 0.01
OF_AXLES = tuple(
    name for name in DETAILS.names if DETAILS[name].shape == (WHEEL_COUNT,) and name != "ackermann"
)
"""Fields that take the parameter of their name."""


class TwoSlopes:
    """A force that is proportional to its argument, with one slope below 0 and another above."""

    def __init__(self, below: float, above: float):
        self.knots = np.zeros(1)
        self._slopes = below, above

    def piece(self, origin: float, inside: float) -> np.ndarray:
        """Coefficients, lowest power first, as those of a TravelCurve."""
        slope = self._slopes[int(inside >= 0.0)]
        return np.array([slope * origin, slope, *[0.0] * (COEFFICIENTS - 2)])


def force_and_slope(curve: TravelCurve | TwoSlopes, x: float) -> tuple[float, float]:
    """The value of a curve at x, and its slope."""
    force, slope, *_ = curve.piece(x, x)
    return float(force), float(slope)


def spring_of(vehicle, axle: str) -> TravelCurve:
    """Force of the spring at one wheel (N) over its compression (m)."""
    table = getattr(vehicle, f"{axle}_spring_force")
    if table is None:
        return TravelCurve(getattr(vehicle, f"{axle}_spring_stiffness"))
    return TravelCurve(table, is_change=False)


def damper_of(vehicle, axle: str) -> TravelCurve | TwoSlopes:
    """Force of the damper at one wheel (N) over the velocity of compression (m/s)."""
    table = getattr(vehicle, f"{axle}_damper_force")
    if table is not None:
        return TravelCurve(table, is_change=False)
    bump = getattr(vehicle, f"{axle}_damping")
    rebound = getattr(vehicle, f"{axle}_rebound_damping")
    return TwoSlopes(bump if rebound is None else rebound, bump)


def mean_damping(vehicle, axle: str) -> float:
    """The damping coefficient of linear models (N s/m): the mean of bump and rebound, if slow."""
    damper = damper_of(vehicle, axle)
    return (force_and_slope(damper, SLOW)[1] + force_and_slope(damper, -SLOW)[1]) / 2


def with_linear_dampers(vehicle):
    """The vehicle with mean damping coefficients where bump and rebound have one each.

    A linear model has one coefficient, and at rest a damper is neither in bump nor in rebound.
    """
    changed = {}
    for axle in AXLES:
        if getattr(vehicle, f"{axle}_rebound_damping") is not None:
            changed[f"{axle}_damping"] = mean_damping(vehicle, axle)
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
    return brentq(
        lambda x: force_and_slope(spring, x)[0] - load, first, last, xtol=FINEST, rtol=FINEST
    )


def compressions_at_rest(vehicle, gravity: float) -> np.ndarray:
    """xsi of each corner, shape (4,) (m; eq. 19); gravity: m/s^2."""
    found, mass = [], vehicle.sprung_mass
    for axle, wheel in AXLES.items():
        share = vehicle.axle_load_share[wheel : wheel + WHEEL_COUNT // 2]
        stiffness = getattr(vehicle, f"{axle}_spring_stiffness")
        if stiffness is not None:
            found += [*static_suspension_compression(mass, share, stiffness, gravity)]
        else:
            spring = spring_of(vehicle, axle)
            found += [compression_under(spring, mass * gravity * each) for each in share]
    return np.array(found)


def stiffnesses_at(vehicle, compressions: np.ndarray) -> np.ndarray:
    """Stiffness of the spring at each wheel at these compressions (m), shape (4,) (N/m)."""
    springs = [spring_of(vehicle, axle) for axle in AXLES for _ in range(WHEEL_COUNT // 2)]
    pairs = zip(springs, compressions, strict=True)
    return np.array([force_and_slope(spring, x)[1] for spring, x in pairs])


def toe_change_of(vehicle, axle: str) -> TravelCurve:
    """Angle of a left wheel (rad, to the left) over its travel (m)."""
    return vehicle.travel_curves[axle][f"{axle}_toe_change"]


CURVES = dict(zip(DETAIL_CURVES, (spring_of, damper_of, toe_change_of), strict=True))


def has_any(vehicle, names: tuple[str, ...]) -> bool:
    """Whether one of these parameters of an axle is given."""
    return any(getattr(vehicle, f"{axle}_{n}") is not None for axle in AXLES for n in names)


def details_of(vehicle) -> np.ndarray:
    """One DETAILS record, shape (1,)."""
    record = np.zeros(1, DETAILS)
    details = record[0]
    details["struts"] = has_any(vehicle, OF_STRUTS)
    details["compliance"] = has_any(vehicle, OF_COMPLIANCE)
    for axle, wheel in AXLES.items():
        both = slice(wheel, wheel + WHEEL_COUNT // 2)
        for name in OF_AXLES:
            details[name][both] = getattr(vehicle, f"{axle}_{name}") or 0.0
        for stop in STOPS:
            if getattr(vehicle, f"{axle}_{stop}_clearance") is None:
                details[f"{stop}_clearance"][both] = np.inf
    for name, curve in CURVES.items():
        parts = zip(*(tabulated([curve(vehicle, axle)]) for axle in AXLES), strict=True)
        knots, origins, pieces = map(np.array, parts)
        details[f"{name}_knots"], details[f"{name}_origins"] = knots, origins
        details[name] = pieces[..., 0]
    details["toe"] *= (-1, 1, -1, 1)
    share = PERCENT * (vehicle.ackermann_percentage or 0.0) * vehicle.front_track / 2
    share /= vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    details["ackermann"][:LR] = share, -share
    return record
