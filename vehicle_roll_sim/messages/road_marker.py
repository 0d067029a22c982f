"""The surface of a road as a marker for RViz and Foxglove."""

import numpy as np

from vehicle_roll_sim.roads.feature import Feature
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.road_mesh import has_mesh, road_mesh

MOST_CELLS = 1500
"""Limit on the cells of the mesh; its message then has at most about 1 MB."""
REACH = 40.0
"""m around the features that are shown."""
TRIANGLE_LIST = 11
"""Kind of a Marker."""
USUAL, SLIPPERY, ROUGH, SOIL = (
    np.array(each)
    for each in ((0.55, 0.57, 0.6), (0.2, 0.55, 0.95), (0.55, 0.4, 0.2), (0.6, 0.45, 0.25))
)
"""Red, green and blue of a road with friction 1, 0 and 2, and of soft soil."""


def road_marker(road: Road, frame_prefix: str = "") -> dict:
    """The fields of a Marker; empty if the road looks like a plane.

    It does not depend on the run: it shows the first 200 m of each feature and their surroundings.
    """
    if not has_mesh(road):
        return {}
    courses = [each.course() for each in road.features if isinstance(each, Feature)]
    mesh = road_mesh(road, np.concatenate([np.zeros((1, 2)), *courses]), MOST_CELLS, REACH)
    points = mesh.vertices[mesh.triangles.ravel()]
    colours = np.repeat(_colours(mesh.friction, mesh.is_soft), 3, axis=0)
    return {
        "header": {"frame_id": frame_prefix + "odom"},
        "ns": "road",
        "type": TRIANGLE_LIST,
        "pose": {"orientation": {"w": 1.0}},
        "scale": dict.fromkeys("xyz", 1.0),
        "color": _named("rgba", (*USUAL.tolist(), 1.0)),
        "frame_locked": True,
        "points": [_named("xyz", each) for each in points.tolist()],
        "colors": [_named("rgba", each) for each in colours.tolist()],
    }


def _named(names: str, values) -> dict[str, float]:
    return dict(zip(names, values, strict=True))


def _colours(friction: np.ndarray, is_soft: np.ndarray) -> np.ndarray:
    """Red, green, blue and opacity by friction, shape (n, 4)."""
    usual = np.where(is_soft[:, np.newaxis], SOIL, USUAL)
    share = np.minimum(np.abs(1.0 - friction), 1.0)[:, np.newaxis]
    other = np.where((friction < 1.0)[:, np.newaxis], SLIPPERY, ROUGH)
    mixed = usual + share * (other - usual)
    return np.column_stack((mixed, np.ones(len(mixed))))
