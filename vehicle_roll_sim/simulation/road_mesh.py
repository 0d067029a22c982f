"""The surface of a road as triangles, for pictures."""

import dataclasses

import numpy as np

from vehicle_roll_sim.model.compiled.jit import COMPILED
from vehicle_roll_sim.model.road.layout import (
    BANKED_CURVE,
    COUNT,
    FEATURE_SIZE,
    GRID,
    HEADER,
    PROFILE,
    RAMP,
    WAVE,
)
from vehicle_roll_sim.model.road.surface import sample
from vehicle_roll_sim.simulation.mesh_cells import UNIT, cells_of
from vehicle_roll_sim.simulation.road import Road

MOST_CELLS = 4000
"""Of a mesh; a cell has about two vertices and five triangles."""
MOST_IN_PYTHON = 1500
"""Of that of a banked curve in plain Python, which takes some 8 ms for a cell."""
REACH = 160.0
"""m around the places of interest that a mesh covers."""
MOST_PLACES = 400
FURTHEST = 1e6
"""m: further away there is no feature."""
HEIGHTS = (RAMP, WAVE, PROFILE, BANKED_CURVE, GRID)
"""Kinds of features with heights."""


@dataclasses.dataclass(frozen=True)
class RoadMesh:
    """Triangles whose corners are on the road, counter-clockwise as seen from above.

    vertices: (n, 3), in the ground frame (m). triangles: (m, 3), numbers of vertices. friction:
    (m,), factor of friction in the middle of each triangle. is_soft: (m,), whether it is soft soil.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    friction: np.ndarray
    is_soft: np.ndarray


def has_mesh(road: Road | None) -> bool:
    """Whether a road looks different from a plane; a plane may still tilt or be commanded."""
    return road is not None and road.ground()[COUNT] > 0


def has_heights(road: Road | None) -> bool:
    """Whether there are features that change heights, or could."""
    return has_mesh(road) and bool(np.isin(_kinds(road), HEIGHTS).any())


def _kinds(road: Road) -> np.ndarray:
    """The kind of each feature that the equations see."""
    ground = road.ground()
    return ground[HEADER : HEADER + FEATURE_SIZE * int(ground[COUNT]) : FEATURE_SIZE]


def road_mesh(
    road: Road, places: np.ndarray, most_cells: int = MOST_CELLS, reach: float = REACH
) -> RoadMesh | None:
    """The mesh of a road around some places, such as the path of a vehicle.

    None for a plane, and if no place is known. places: (n, 2) (m). The mesh covers everything up
    to `reach` (m) beyond them. Close to them it deviates from the road by a few mm, further away by
    more, and also if the road would need more than `most_cells`; in plain Python a banked curve has
    at most MOST_IN_PYTHON. The same arguments give the same mesh.
    """
    if not has_mesh(road):
        return None
    places = thinned(places)
    if not len(places):
        return None
    if not COMPILED and BANKED_CURVE in _kinds(road):
        most_cells = min(most_cells, MOST_IN_PYTHON)
    cells = cells_of(road, places, most_cells, reach)
    corners, triangles = _triangles(cells)
    points = corners * UNIT
    heights, _, _ = sampled(road, points).T
    middles = points[triangles].mean(axis=1)
    _, friction, yielding = sampled(road, middles).T
    return RoadMesh(np.column_stack((points, heights)), triangles, friction, yielding > 0.0)


def sampled(road: Road, points: np.ndarray) -> np.ndarray:
    """Height (m), friction and compliance (m/N) of a road at points (n, 2), shape (n, 3)."""
    found = np.empty((len(points), 3))
    sample(np.ascontiguousarray(points, float), road.ground(), found)
    return found


def thinned(places: np.ndarray) -> np.ndarray:
    """The places that are known and apart from each other, at most MOST_PLACES."""
    known, spacing = places[(np.abs(places) < FURTHEST).all(axis=1)], 1.0
    while True:
        _, first = np.unique(np.floor(known / spacing), axis=0, return_index=True)
        if len(first) <= MOST_PLACES:
            return known[np.sort(first)]
        spacing *= 2.0


def _triangles(cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points in UNITs, shape (n, 2), and triangles: a fan around the middle of each cell.

    The fan meets every corner of other cells on the sides of its cell, so the mesh has no gaps.
    """
    x0, x1, y0, y1 = cells.T
    pairs = ((x0, y0), (x1, y0), (x0, y1), (x1, y1))
    corners = np.unique(np.concatenate([np.column_stack(each) for each in pairs]), axis=0)
    along_x, along_y = _lines(corners, 1), _lines(corners, 0)
    numbers = {(x, y): k for k, (x, y) in enumerate(corners.tolist())}
    fans, middles = [], len(corners)
    for k, (west, east, south, north) in enumerate(cells.tolist()):
        ring = [
            *((x, south) for x in _between(along_x[south], west, east)),
            *((east, y) for y in _between(along_y[east], south, north)),
            *((x, north) for x in reversed(_between(along_x[north], west, east, 1))),
            *((west, y) for y in reversed(_between(along_y[west], south, north, 1))),
        ]
        outer = [numbers[each] for each in ring]
        fans += [(middles + k, a, b) for a, b in zip(outer, [*outer[1:], outer[0]], strict=True)]
    centres = np.column_stack((x0 + x1, y0 + y1)) / 2
    return np.concatenate((corners, centres)), np.array(fans)


def _lines(corners: np.ndarray, axis: int) -> dict[int, np.ndarray]:
    """By the coordinate along an axis: the other coordinates of all points there, rising."""
    order = np.lexsort((corners[:, 1 - axis], corners[:, axis]))
    sorted_ = corners[order]
    values, first = np.unique(sorted_[:, axis], return_index=True)
    parts = np.split(sorted_[:, 1 - axis], first[1:])
    return dict(zip(values.tolist(), parts, strict=True))


def _between(line: np.ndarray, low: int, high: int, shift: int = 0) -> list[int]:
    """The points of a line from `low` to before `high`; shift: of both ends, in points."""
    first, last = np.searchsorted(line, (low, high)) + shift
    return line[first:last].tolist()
