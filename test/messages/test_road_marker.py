"""The marker of a road is its mesh, as another library reads it."""

import dataclasses
import importlib
import sys
import types

import numpy as np
import pytest
from road_kinds import FEATURES, ROADS, TILT, road

from vehicle_roll_sim.messages.road_marker import (
    MOST_CELLS,
    SLIPPERY,
    SOIL,
    TRIANGLE_LIST,
    USUAL,
    road_marker,
)
from vehicle_roll_sim.messages.topics import ROAD
from vehicle_roll_sim.simulation.road import Road

LARGEST = 1_200_000
"""Bytes of a message: MOST_CELLS of about five triangles, each of 3 (24 + 16) bytes, and some."""
CORNERS = 3
KINDS = {
    "header": "std_msgs/Header",
    "ns": "string",
    "type": "int32",
    "pose": "geometry_msgs/Pose",
    "scale": "geometry_msgs/Vector3",
    "color": "std_msgs/ColorRGBA",
    "frame_locked": "boolean",
    "points": "sequence<geometry_msgs/Point>",
    "colors": "sequence<std_msgs/ColorRGBA>",
}
"""Kinds of the fields of a Marker that are filled, as rclpy names them."""


@pytest.fixture
def encoding():
    """The encoding of bags, whose library is optional."""
    pytest.importorskip("rosbags", reason="bags need the library rosbags")
    from vehicle_roll_sim.bags import encoding

    return encoding


def points_of(marker: dict) -> np.ndarray:
    """Corners of its triangles, shape (m, 3, 3) (m)."""
    values = [[point[axis] for axis in "xyz"] for point in marker["points"]]
    return np.reshape(values, (-1, CORNERS, 3))


def colours_of(marker: dict) -> np.ndarray:
    """Red, green, blue and opacity of each triangle."""
    values = np.array([[colour[part] for part in "rgba"] for colour in marker["colors"]])
    shared = values.reshape(-1, CORNERS, 4)
    assert (shared == shared[:, :1]).all()
    return shared[:, 0]


def test_a_marker_is_read_as_it_was_written(encoding):
    given = road_marker(ROADS["dip"], "car/")
    data = encoding.encode(ROAD.type, given)
    assert data == encoding.encode(ROAD.type, road_marker(ROADS["dip"], "car/"))
    marker = encoding.decode(data, ROAD.type)
    assert (marker.header.frame_id, marker.type, marker.action) == ("car/odom", TRIANGLE_LIST, 0)
    assert (marker.pose.orientation.w, marker.scale.x, marker.color.a) == (1.0, 1.0, 1.0)
    assert marker.frame_locked
    assert (marker.lifetime.sec, marker.header.stamp.sec) == (0, 0)  # for ever, at any time
    read = [[point.x, point.y, point.z] for point in marker.points]
    assert np.reshape(read, (-1, CORNERS, 3)).tolist() == points_of(given).tolist()
    assert len(marker.colors) == len(marker.points)


def test_the_node_fills_the_class_of_a_marker_with_the_same(encoding, monkeypatch):
    """Of a stand-in, since visualization_msgs is not among the wheels; what is in it is of ROS."""
    pytest.importorskip("rclpy", reason="the node's messages need ROS 2")
    from vehicle_roll_sim.ros.encoding import _message

    package = types.ModuleType("visualization_msgs.msg")
    package.Marker = Marker
    _, members = encoding.TYPES.fielddefs[ROAD.type]
    assert KINDS.keys() <= {name for name, _ in members}
    monkeypatch.setitem(sys.modules, "visualization_msgs", types.ModuleType("visualization_msgs"))
    monkeypatch.setitem(sys.modules, package.__name__, package)
    given = road_marker(ROADS["dip"], "car/")
    filled = _message(ROAD.type, given)
    assert (filled.header.frame_id, filled.type, filled.ns) == ("car/odom", TRIANGLE_LIST, "road")
    assert (filled.pose.orientation.w, filled.scale.z, filled.frame_locked) == (1.0, 1.0, True)
    found = [[point.x, point.y, point.z] for point in filled.points]
    assert np.reshape(found, (-1, CORNERS, 3)).tolist() == points_of(given).tolist()
    assert [each.b for each in filled.colors] == [each["b"] for each in given["colors"]]


class Marker:
    """Has the fields that are filled; messages in them are real ones."""

    @staticmethod
    def get_fields_and_field_types() -> dict[str, str]:
        return KINDS

    def __init__(self):
        for name, kind in KINDS.items():
            package, _, message = kind.partition("/")
            if message and not kind.startswith("sequence"):
                setattr(self, name, getattr(importlib.import_module(f"{package}.msg"), message)())


def test_its_triangles_are_on_the_road_and_cover_the_feature():
    points = points_of(road_marker(ROADS["dip"]))
    surface = ROADS["dip"].surface
    assert all(surface(x, y)[0] == z for x, y, z in points.reshape(-1, 3)[::7].tolist())
    assert points[..., 2].min() == pytest.approx(-0.1, abs=0.004)  # how exact a mesh is
    begin, end = FEATURES["dip"]["start"], FEATURES["dip"]["start"] + FEATURES["dip"]["length"]
    assert points[..., 0].min() < begin - 10.0
    assert points[..., 0].max() > end + 10.0


def test_its_colours_are_those_of_friction_and_of_soil():
    icy = {"kind": "patch", "start": 8.0, "friction": 0.0, "left": 0.0}
    soil = {"kind": "soft_soil", "start": 8.0, "right": 0.0}
    marker = road_marker(road(icy, soil))
    middles, colours = points_of(marker).mean(axis=1), colours_of(marker)[:, :3]
    ahead, left = middles[:, 0] > 8.0, middles[:, 1] > 0.0
    for where, expected in ((~ahead, USUAL), (ahead & ~left, SLIPPERY), (ahead & left, SOIL)):
        assert where.any()
        assert (colours[where] == expected).all()


def test_the_largest_marker_has_about_a_megabyte(encoding):
    rough = FEATURES["random profile"] | {"roughness": "H", "length": 1000.0}
    marker = road_marker(road(rough, FEATURES["chessboard"]))
    assert len(encoding.encode(ROAD.type, marker)) < LARGEST
    assert len(marker["points"]) > CORNERS * 4 * MOST_CELLS * 0.9  # the budget is used


def test_a_plane_has_none():
    assert road_marker(Road()) == {}
    assert road_marker(dataclasses.replace(Road(), grade=0.1)) == {}
    assert road_marker(road(TILT, {"kind": "commanded"})) == {}
