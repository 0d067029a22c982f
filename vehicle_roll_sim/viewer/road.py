"""The road of a run as the page gets it: a mesh, and columns of the road under the vehicle."""

from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.road_mesh import (
    MOST_CELLS,
    RoadMesh,
    has_heights,
    has_mesh,
    road_mesh,
    sampled,
)
from vehicle_roll_sim.viewer.packing import packed

LEAST_CELLS = 250
"""Smallest limit on the cells of each mesh, on a page with runs on many roads."""
PER_FRICTION, MOST_FRICTION = 100, 655.0
"""Friction is sent in hundredths, as integers of 16 bits."""


def roads_of(runs: Sequence) -> list[Road]:
    """The roads of some runs (ViewedRuns) that have a mesh, each once."""
    found = []
    for run in runs:
        if has_mesh(run.road) and run.road not in found:
            found.append(run.road)
    return found


def values_of_roads(runs: Sequence) -> list[dict | None]:
    """The meshes of `roads_of` these runs, each around all their paths on it."""
    roads = roads_of(runs)
    most = max(MOST_CELLS // max(len(roads), 1), LEAST_CELLS)
    found = []
    for road in roads:
        paths = [path_of(run.history) for run in runs if run.road == road]
        found.append(values_of_mesh(road_mesh(road, np.concatenate(paths), most)))
    return found


def path_of(history: History) -> np.ndarray:
    """Places of the sprung c.g. on the ground, shape (n, 2) (m)."""
    return np.column_stack((history["x"], history["y"]))


def values_of_mesh(mesh: RoadMesh | None) -> dict | None:
    """A mesh as JSON has it; None if there is none."""
    if mesh is None:
        return None
    friction = np.minimum(mesh.friction, MOST_FRICTION) * PER_FRICTION
    return {
        "vertices": packed(mesh.vertices, "<f4"),
        "triangles": packed(mesh.triangles, "<u2"),
        "friction": packed(np.round(friction), "<u2"),
        "soft": packed(mesh.is_soft, "u1"),
    }


def under(history: History, road: Road | None, scene: dict) -> dict[str, np.ndarray]:
    """Columns of the road at each row: what it has under the c.g. and the wheels, and its tilt.

    ground, ground_lf ...: heights (m), only if it has any. tilt: angle (rad), only of a tilt
    table.
    """
    columns = {}
    if road is not None and road.tilt:
        columns["tilt"] = np.array([road.tilt.angle(time) for time in history["time"]])
    if has_heights(road):
        middle, yaw = path_of(history), history["yaw"]
        ahead = np.column_stack((np.cos(yaw), np.sin(yaw)))
        aside = np.column_stack((-np.sin(yaw), np.cos(yaw)))
        columns["ground"] = _heights(road, middle)
        for name, wheel in zip(WHEELS, scene["wheels"], strict=True):
            x, y, _ = wheel["place"]
            columns[f"ground_{name}"] = _heights(road, middle + x * ahead + y * aside)
    return columns


def _heights(road: Road, points: np.ndarray) -> np.ndarray:
    """Heights at points (m); nan where a point is unknown."""
    is_known = np.isfinite(points).all(axis=1)
    heights = np.full(len(points), np.nan)
    heights[is_known] = sampled(road, points[is_known])[:, 0]
    return heights
