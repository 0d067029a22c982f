"""From handwheel to road wheels and back, by a steering ratio or a table.

A table has pairs of handwheel and road-wheel angle (rad), straight between and beyond them; one
without negative angles counts to both sides.
"""

import itertools

import numpy as np

from vehicle_roll_sim.declaration import InputError

Gear = float | tuple[tuple[float, float], ...]
"""A steering ratio or a table."""


def check_gear(name: str, table: tuple) -> None:
    """Raise InputError for a table that does not have its zero at zero, or does not rise."""
    if (0.0, 0.0) not in table:
        raise InputError(name, table, "a table with the point [0, 0]")
    if not all(after > before for (_, before), (_, after) in itertools.pairwise(table)):
        raise InputError(name, table, "road-wheel angles that rise with the handwheel angle")


def _both_sides(table: tuple) -> np.ndarray:
    """Handwheel and road-wheel angles, shape (2, n) (rad)."""
    points = np.array(table).T
    return np.hstack((-points[:, :0:-1], points)) if points[0, 0] == 0.0 else points


def _along(x, at: np.ndarray, values: np.ndarray):
    """Straight between the points, and on beyond the first and last of them."""
    x = np.asarray(x)
    inside = np.interp(x, at, values)
    before = (values[1] - values[0]) / (at[1] - at[0]) * np.minimum(x - at[0], 0.0)
    after = (values[-1] - values[-2]) / (at[-1] - at[-2]) * np.maximum(x - at[-1], 0.0)
    return inside + before + after


def to_road_wheels(handwheel, gear: Gear):
    """Road-wheel angles of handwheel angles (both deg)."""
    if not isinstance(gear, tuple):
        return handwheel / gear
    angles, road_wheels = np.degrees(_both_sides(gear))
    return _along(handwheel, angles, road_wheels)


def to_handwheel(road_wheel, gear: Gear):
    """Handwheel angles of road-wheel angles (both deg)."""
    if not isinstance(gear, tuple):
        return road_wheel * gear
    angles, road_wheels = np.degrees(_both_sides(gear))
    return _along(road_wheel, road_wheels, angles)


def ratio_ahead(gear: Gear) -> float:
    """The steering ratio for small angles."""
    return float(to_handwheel(1e-6, gear)) / 1e-6 if isinstance(gear, tuple) else gear


def in_words(gear: Gear) -> str:
    """How a line of text names it."""
    return "steering_gear" if isinstance(gear, tuple) else f"steering_ratio {gear:g}"
