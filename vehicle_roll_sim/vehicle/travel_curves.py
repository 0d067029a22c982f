"""Curves over wheel travel: from the numbers of a vehicle file to the polynomials of the model.

A table becomes a smooth curve through its points: straight outside them, with continuous first and
second derivatives, and rising or falling wherever the points do. Between two points it is the
polynomial of fifth degree with given slopes and second derivatives at both. The slopes are those of
a cubic spline through the points, the second derivatives those of a cubic spline through the
slopes. Where such a curve would turn back between points that do not, its slopes are limited and
its second derivatives set to 0.
"""

import dataclasses
import functools
from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.work_space import COEFFICIENTS, KNOTS

STEEPEST = 2.0
"""Limited slope over that of the chord; with no curvature at both ends, a piece then does not turn
back: its slope stays above an eighth of the chord's even if it begins and ends with the limit."""
SAMPLES = np.linspace(0.0, 1.0, 65)
"""Where the slope of a piece is examined, as shares of its length."""
KEPT = 100
"""Number of curves that are kept for further vehicles with the same ones."""
NO_KNOTS = np.zeros(0)
ROUNDING = 1e-12
"""Relative tolerance of that examination."""


class TravelCurve:
    """A quantity as a function of wheel travel, counted from its value at travel 0.

    given: a number, its change per metre of travel, or pairs of travel (m) and value. is_change:
    False for a quantity that is not counted from travel 0. Attributes: `knots` (m), and `key`, the
    same for curves that are the same bit for bit.
    """

    def __init__(self, given: float | tuple, is_change: bool = True):
        self._slope = given if isinstance(given, float) else None
        points = np.array(given, float).tobytes()
        self.key = (points, is_change)
        if self._slope is None:
            self.knots, self._ends = _knots_and_ends(*self.key)
        else:
            self.knots = NO_KNOTS

    def piece(self, origin: float, inside: float) -> np.ndarray:
        """Coefficients, lowest power first, of the polynomial that holds at the travel `inside`.

        origin: travel from which it is counted (m).
        """
        if self._slope is None:
            return _piece(self.knots, self._ends, origin, inside)
        return np.array(_on_line(self._slope, origin, inside))


def _on_line(slope: float, origin: float, inside: float) -> list[float]:
    """The coefficients of a line, to the bit those of `_piece` for its points at 0 and 1."""
    start, value = (1.0, slope) if inside >= 1.0 else (0.0, 0.0)
    shift = float(origin) - start
    slope += shift * 0.0  # the sign of a slope of -0.0
    return [value + shift * slope, slope, *[0.0] * (COEFFICIENTS - 2)]


@functools.lru_cache(maxsize=KEPT)
def _knots_and_ends(points: bytes, is_change: bool) -> tuple[np.ndarray, np.ndarray]:
    """Travels, shape (n,), and values, slopes and second derivatives there, shape (n, 3)."""
    knots, values = np.frombuffer(points).reshape(-1, 2).T
    ends = _ends(knots, values)
    if is_change:
        ends[:, 0] -= _piece(knots, ends, 0.0, 0.0)[0]
    ends.flags.writeable = False
    return knots, ends


def _piece(knots: np.ndarray, ends: np.ndarray, origin: float, inside: float) -> np.ndarray:
    """The polynomial at a travel, as `TravelCurve.piece`, from the results of `_ends`."""
    place = int(np.searchsorted(knots, inside, side="right")) - 1
    if place < 0 or place == len(knots) - 1:
        start = max(place, 0)
        value, slope, _ = ends[start]
        local = np.array([value, slope, *[0.0] * (COEFFICIENTS - 2)])
    else:
        start = place
        local = _quintic(*ends[place : place + 2], knots[place + 1] - knots[place])
    return _counted_from(local, origin - knots[start])


def _ends(knots: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Value, slope and second derivative at every knot, shape (n, 3)."""
    if len(knots) == 2:
        slope = (values[1] - values[0]) / (knots[1] - knots[0])
        return np.column_stack((values, [slope] * 2, [0.0] * 2))
    from scipy.interpolate import CubicSpline  # slow to import, and for tables only

    slopes = CubicSpline(knots, values)(knots, 1)
    ends = np.column_stack((values, slopes, CubicSpline(knots, slopes)(knots, 1)))
    ends[[0, -1], 2] = 0.0  # straight outside
    chords = np.diff(values) / np.diff(knots)
    limited = np.zeros(len(knots), bool)
    while (turning := _turning_back(ends, knots, chords) & ~_both(limited)).any():
        limited[:-1] |= turning
        limited[1:] |= turning
        ends[limited, 1] = _limited(ends[:, 1], chords)[limited]
        ends[limited, 2] = 0.0
    return ends


def _both(marks: np.ndarray) -> np.ndarray:
    """Whether both ends of each interval are marked."""
    return marks[:-1] & marks[1:]


def _turning_back(ends: np.ndarray, knots: np.ndarray, chords: np.ndarray) -> np.ndarray:
    """The intervals in which the curve turns back though the points around it do not.

    Next to a point where the points themselves turn round, a curve may pass its highest or lowest
    value between them. Where two points are equal it has to be level.
    """
    direction = np.sign(chords)
    around = np.concatenate((direction[:1], direction, direction[-1:]))
    same = (around[:-2] == direction) & (around[2:] == direction)
    found = np.zeros(len(chords), bool)
    for i, length in enumerate(np.diff(knots)):
        slopes = np.polynomial.polynomial.polyval(
            SAMPLES * length, _derivative(_quintic(ends[i], ends[i + 1], length))
        )
        if direction[i] == 0.0:
            found[i] = np.abs(slopes).max() > 0.0
        elif same[i]:
            found[i] = (slopes * direction[i]).min() < -ROUNDING * abs(chords[i])
    return found


def _limited(slopes: np.ndarray, chords: np.ndarray) -> np.ndarray:
    """Slopes at the knots that do not exceed STEEPEST times the flatter chord beside them.

    0 where the chords beside a knot have different signs or one of them is level.
    """
    before = np.concatenate((chords[:1], chords))
    after = np.concatenate((chords, chords[-1:]))
    most = STEEPEST * np.minimum(np.abs(before), np.abs(after))
    along = np.where(before * after > 0.0, np.sign(before), 0.0)
    return along * np.clip(slopes * along, 0.0, most)


def _quintic(start: np.ndarray, end: np.ndarray, length: float) -> np.ndarray:
    """The polynomial of fifth degree with these values, slopes and second derivatives."""
    value, slope, bend = start
    gap = end[0] - value - length * (slope + length * bend / 2)
    lag = (end[1] - slope - length * bend) * length
    rest = (end[2] - bend) * length**2
    third = (10 * gap - 4 * lag + rest / 2) / length**3
    fourth = (-15 * gap + 7 * lag - rest) / length**4
    fifth = (6 * gap - 3 * lag + rest / 2) / length**5
    return np.array([value, slope, bend / 2, third, fourth, fifth])


def _derivative(coefficients: np.ndarray) -> np.ndarray:
    return np.polynomial.polynomial.polyder(coefficients)


def _counted_from(coefficients: np.ndarray, shift: float) -> np.ndarray:
    """The same polynomial, of x - shift."""
    shifted, shift = coefficients.tolist(), float(shift)  # quicker than elements of an array
    for first in range(len(shifted)):
        for k in range(len(shifted) - 2, first - 1, -1):
            shifted[k] += shift * shifted[k + 1]
    return np.array(shifted)


def common_knots(curves: Sequence[TravelCurve]) -> np.ndarray:
    """All knots of the curves of an axle, increasing (m)."""
    if not any(len(curve.knots) for curve in curves):
        return NO_KNOTS
    return np.unique(np.concatenate([curve.knots for curve in curves]))


@dataclasses.dataclass(frozen=True)
class _Same:
    """Curves that compare equal to others with the same values."""

    curves: tuple = dataclasses.field(compare=False)
    keys: tuple


def tabulated(curves: Sequence[TravelCurve]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Knots, origins and coefficients of an axle's curves, as the fields travel_* of VEHICLE.

    Shapes (KNOTS,), (KNOTS + 1,) and (KNOTS + 1, COEFFICIENTS, curves); not to be changed, since
    vehicles with the same curves share them.
    """
    return _tabulated(_Same(tuple(curves), tuple(curve.key for curve in curves)))


@functools.lru_cache(maxsize=KEPT)
def _tabulated(same: _Same) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    curves = same.curves
    used = common_knots(curves)
    knots, origins = np.full(KNOTS, np.inf), np.zeros(KNOTS + 1)
    knots[: len(used)] = used
    coefficients = np.zeros((KNOTS + 1, COEFFICIENTS, len(curves)))
    for row in range(len(used) + 1):
        if len(used):
            origins[row] = used[max(row - 1, 0)]
        inside = _inside(used, row)
        for k, curve in enumerate(curves):
            coefficients[row, :, k] = curve.piece(origins[row], inside)
    for array in (knots, origins, coefficients):
        array.flags.writeable = False
    return knots, origins, coefficients


def _inside(knots: np.ndarray, row: int) -> float:
    """A travel within an interval (m): the first and last are beyond the knots."""
    if len(knots) == 0:
        return 0.0
    if row == 0:
        return knots[0] - 1.0
    if row == len(knots):
        return knots[-1] + 1.0
    return (knots[row - 1] + knots[row]) / 2


def check_knots(curves: dict[str, TravelCurve]) -> None:
    """Raise InputError if the tables of an axle have too many different travels.

    curves: by the names of their parameters.
    """
    count = len(common_knots(list(curves.values())))
    if count > KNOTS:
        name = next(name for name, curve in curves.items() if len(curve.knots))
        allowed = f"at most {KNOTS} different travels in all tables of an axle"
        raise InputError(name, "", allowed, f"the tables of this axle have {count}")
