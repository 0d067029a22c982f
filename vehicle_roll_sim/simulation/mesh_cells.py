"""Rectangles into which a road is divided, so that between their corners it is almost straight."""

import math

import numpy as np

from vehicle_roll_sim.model.road.surface import sample
from vehicle_roll_sim.roads.feature import Feature
from vehicle_roll_sim.simulation.road import Road

UNIT = 2.0**-10
"""m: all corners are at whole numbers of it, so that those of neighbours meet exactly."""
NEAR = 4.0
"""m: up to this distance from a place cells are finest; at twice the distance, half as fine."""
DEVIATION = 0.004
"""m that the road may be off the straight line from one side of a near cell to the other."""
SIDE = 3.0
"""m: longest side of a near cell."""
EDGE = 0.25
"""m: longest side of a near cell in which friction changes at no known edge."""
SHORTEST = 20
"""UNITs: no side is halved to less."""
POINTS = 9
"""Number of points in either direction at which a cell is checked."""
CHANGE = 0.02
"""Smallest change of friction that counts."""
CLOSE = 1e-6
"""Of a side: how far the outermost points are inside the cell, on its side of an edge."""


def cells_of(road: Road, places: np.ndarray, most: int, reach: float) -> np.ndarray:
    """West, east, south and north side of each rectangle, in UNITs, shape (n, 4).

    Arguments as for `road_mesh`. Rectangles are divided, the worst first, until all are good enough
    or their largest number is reached.
    """
    low, high = places.min(axis=0) - reach, places.max(axis=0) + reach
    box = [*np.floor((low[0], high[0], low[1], high[1])) / UNIT]
    cells = np.array([box], dtype=np.int64)
    edges = _edges(road, low, high)
    score, axis, cut = _judged(cells, road, places, edges)
    while len(cells) < most and (score > 1.0).any():
        worst = np.argsort(-score, kind="stable")[: most - len(cells)]
        worst = np.sort(worst[score[worst] > 1.0])
        parts = _divided(cells[worst], axis[worst], cut[worst])
        cells = np.concatenate((np.delete(cells, worst, axis=0), parts))
        judged = _judged(parts, road, places, edges)
        score, axis, cut = (
            np.concatenate((np.delete(known, worst), new))
            for known, new in zip((score, axis, cut), judged, strict=True)
        )
    return cells


def _divided(cells: np.ndarray, axis: np.ndarray, cut: np.ndarray) -> np.ndarray:
    """Two parts of each cell, cut along x (axis 0) or y (1) at a place."""
    lower, upper, rows = cells.copy(), cells.copy(), np.arange(len(cells))
    lower[rows, 2 * axis + 1] = upper[rows, 2 * axis] = cut
    return np.concatenate((lower, upper))


def _judged(cells: np.ndarray, road: Road, places: np.ndarray, edges: tuple) -> tuple:
    """Score of each cell (above 1: to be divided), the axis along which to divide it, and where."""
    scale = np.maximum(1.0, _distance(cells * UNIT, places) / NEAR)
    sizes = np.column_stack((cells[:, 1] - cells[:, 0], cells[:, 3] - cells[:, 2]))
    scores = _scores(cells * UNIT, road, scale[:, np.newaxis])
    middles = np.column_stack((cells[:, 0] + cells[:, 1], cells[:, 2] + cells[:, 3])) // 2
    for axis, known in enumerate(edges):
        at, where = _nearest_edge(cells, axis, known)
        is_cut = where & (sizes[:, axis] * UNIT > EDGE * scale)
        middles[where, axis] = at[where]
        scores[is_cut, axis] += sizes[is_cut, axis] * UNIT / (EDGE * scale[is_cut])
    scores[sizes < 2 * SHORTEST] = 0.0
    axis = np.argmax(scores, axis=1)
    rows = np.arange(len(cells))
    return scores[rows, axis], axis, middles[rows, axis]


def _distance(cells: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Distance of each cell from the nearest place (m)."""
    x0, x1, y0, y1 = (each[:, np.newaxis] for each in cells.T)
    ahead = np.maximum(np.maximum(x0 - places[:, 0], places[:, 0] - x1), 0.0)
    aside = np.maximum(np.maximum(y0 - places[:, 1], places[:, 1] - y1), 0.0)
    return np.sqrt((ahead**2 + aside**2).min(axis=1))


def _scores(cells: np.ndarray, road: Road, scale: np.ndarray) -> np.ndarray:
    """How much each cell is too large, bent or uneven in friction along x and y, shape (n, 2)."""
    share = np.linspace(CLOSE, 1.0 - CLOSE, POINTS)
    sizes = np.column_stack((cells[:, 1] - cells[:, 0], cells[:, 3] - cells[:, 2]))
    x = cells[:, :1] + share * sizes[:, :1]
    y = cells[:, 2:3] + share * sizes[:, 1:]
    shape = (len(cells), POINTS, POINTS)
    points = np.stack(
        (np.broadcast_to(x[:, :, np.newaxis], shape), np.broadcast_to(y[:, np.newaxis], shape)), -1
    ).reshape(-1, 2)
    found = np.empty((len(points), 3))
    sample(points, road.ground(), found)
    height, friction, softness = (each.reshape(shape) for each in found.T)
    kind = friction + 10.0 * (softness > 0.0)
    scores = sizes / (SIDE * scale)
    twist = np.abs(height[:, 0, 0] + height[:, -1, -1] - height[:, 0, -1] - height[:, -1, 0]) / 16
    longer = np.argmax(sizes, axis=1)
    rows = np.arange(len(cells))
    scores[rows, longer] = np.maximum(scores[rows, longer], twist / (DEVIATION * scale[:, 0]))
    for axis in (0, 1):
        along = np.moveaxis(height, axis + 1, -1)
        straight = along[..., :1] + share * (along[..., -1:] - along[..., :1])
        bend = np.abs(along - straight).max(axis=(1, 2)) / (DEVIATION * scale[:, 0])
        changes = np.ptp(kind, axis=axis + 1).max(axis=1) > CHANGE
        uneven = np.where(changes, sizes[:, axis] / (EDGE * scale[:, 0]), 0.0)
        scores[:, axis] = np.maximum(scores[:, axis], np.maximum(bend, uneven))
    return scores


def _edges(road: Road, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Edges across x and across y: where, from and to, each of shape (n, 3), in UNITs.

    Those of features whose heading is along an axis, as far as they are in the box; other edges are
    found by sampling.
    """
    found = ([], [])
    for feature in road.features:
        if not isinstance(feature, Feature) or feature.heading % 90.0:
            continue
        along, across = feature.edges()
        right, left = min(across, default=-math.inf), max(across, default=math.inf)
        for place in along:
            _keep(found, feature, ((place, right), (place, left)), low, high)
        for place in across:
            _keep(found, feature, ((min(along), place), (max(along), place)), low, high)
    return tuple(np.array(each, float).reshape(-1, 3) for each in found)


def _keep(found: tuple, feature: Feature, ends: tuple, low: np.ndarray, high: np.ndarray) -> None:
    """Add the line between two points of a feature, as far as it is in the box."""
    far = 2.0 * np.abs((low, high)).max() + abs(feature.start) + abs(feature.offset)
    a, b = feature.placed(np.clip(ends, -far, far))
    axis = int(abs(a[1] - b[1]) < abs(a[0] - b[0]))
    if low[axis] < a[axis] < high[axis]:
        reach = sorted((a[1 - axis], b[1 - axis]))
        found[axis].append([round(each / UNIT) for each in (a[axis], *reach)])


def _nearest_edge(cells: np.ndarray, axis: int, edges: np.ndarray) -> tuple:
    """Of each cell the edge across an axis that is nearest to its middle, and if there is one."""
    low, high = cells[:, 2 * axis, np.newaxis], cells[:, 2 * axis + 1, np.newaxis]
    first, last = cells[:, 2 - 2 * axis, np.newaxis], cells[:, 3 - 2 * axis, np.newaxis]
    at, begin, end = edges.T
    inside = (low < at) & (at < high) & (begin < last) & (end > first)
    if not len(edges):
        return np.zeros(len(cells), np.int64), np.zeros(len(cells), bool)
    off = np.where(inside, np.abs(2 * at - low - high), math.inf)
    nearest = off.argmin(axis=1)
    return at[nearest].astype(np.int64), inside.any(axis=1)
