"""The mesh of a road lies on it, has no gaps, and keeps to its budget."""

import collections

import numpy as np
import pytest
from matplotlib.tri import LinearTriInterpolator, Triangulation
from road_kinds import FEATURES, ROADS, TILT, road

from vehicle_roll_sim.roads.feature import Feature
from vehicle_roll_sim.simulation import road_mesh as meshes
from vehicle_roll_sim.simulation.mesh_cells import DEVIATION, UNIT
from vehicle_roll_sim.simulation.road_mesh import (
    MOST_IN_PYTHON,
    MOST_PLACES,
    RoadMesh,
    has_heights,
    has_mesh,
    road_mesh,
    sampled,
    thinned,
)

PATH = np.column_stack((np.linspace(0.0, 60.0, 200), np.zeros(200)))
"""m: straight ahead."""
REACH = 40.0
"""m"""


@pytest.fixture(scope="module")
def meshed() -> dict[str, RoadMesh]:
    """The meshes of the roads around the path."""
    return {name: road_mesh(each, PATH, reach=REACH) for name, each in ROADS.items()}


def flat(mesh: RoadMesh) -> np.ndarray:
    """x and y of the corners of all triangles, shape (m, 3, 2)."""
    return mesh.vertices[mesh.triangles][:, :, :2]


def areas(mesh: RoadMesh) -> np.ndarray:
    """Of the triangles as seen from above, positive counter-clockwise (m^2)."""
    a, b, c = np.moveaxis(flat(mesh), 1, 0)
    (ax, ay), (bx, by) = (b - a).T, (c - a).T
    return (ax * by - ay * bx) / 2


@pytest.mark.parametrize("name", ROADS)
def test_all_corners_are_on_the_road_and_the_triangles_face_up(meshed, name):
    mesh, surface = meshed[name], ROADS[name].surface
    assert [surface(x, y)[0] for x, y, _ in mesh.vertices] == mesh.vertices[:, 2].tolist()
    assert areas(mesh).min() > 0.0
    middles = flat(mesh).mean(axis=1)
    assert [surface(x, y)[3] for x, y in middles] == mesh.friction.tolist()
    assert mesh.is_soft.any() == (name == "soft soil")


@pytest.mark.parametrize("name", ROADS)
def test_the_triangles_cover_everything_around_the_path_once_and_without_a_gap(meshed, name):
    """Each side has its neighbour in the opposite sense, unless it is on the border of the box."""
    mesh = meshed[name]
    box = np.array([[0.0 - REACH, -REACH], [60.0 + REACH, REACH]])
    covered = np.prod(np.diff(np.floor(box / UNIT) * UNIT, axis=0))
    assert areas(mesh).sum() == pytest.approx(covered, rel=1e-12)  # rounding of some 5000 numbers
    sides = collections.Counter(
        (a, b) for t in mesh.triangles.tolist() for a, b in zip(t, (*t[1:], t[0]), strict=True)
    )
    assert set(sides.values()) == {1}
    places = mesh.vertices[:, :2]
    for a, b in sides:
        on_border = ((places[a] == places[b]) & (places[a] == box).any(axis=0)).any()
        assert ((b, a) in sides) != on_border


@pytest.mark.parametrize("name", ROADS)
def test_close_to_the_path_the_mesh_is_the_road_within_a_centimetre(meshed, name):
    """Along each direction of a cell the deviation is limited; both together can be twice as much.

    The grid's heights are random from point to point, the steepest road here.
    """
    mesh, generator = meshed[name], np.random.default_rng(1)
    points = generator.uniform((1.0, -1.5), (58.0, 1.5), (400, 2))
    surface = Triangulation(*mesh.vertices[:, :2].T, mesh.triangles)
    found = LinearTriInterpolator(surface, mesh.vertices[:, 2])(*points.T)
    heights = sampled(ROADS[name], points)[:, 0]
    assert np.abs(found - heights).max() < 2 * DEVIATION


def test_the_face_of_a_curb_is_as_steep_as_it_is():
    """All along a path of 150 m: no more than a few mm are cut off where it is rounded."""
    curb = ROADS["curb"].features[0]
    mesh = road_mesh(ROADS["curb"], PATH * [2.5, 1.0])
    x, y, height = mesh.vertices.T
    beside, top = (x > 10.0) & (x < 100.0), 0.8 + curb.face
    assert (height[beside & (y <= 0.8)] == 0.0).all()
    assert height[beside & (y >= top + UNIT)] == pytest.approx(curb.height, abs=1e-12)
    corners = mesh.vertices[mesh.triangles]
    a, b, c = np.moveaxis(corners, 1, 0)
    normal = np.cross(b - a, c - a)
    slope = np.hypot(*normal[:, :2].T) / normal[:, 2]
    _, _, steepest, _ = ROADS["curb"].surface(50.0, 0.8 + curb.face / 2)
    for begin in range(10, 100, 10):
        is_here = (corners[:, :, 0].max(axis=1) >= begin) & (corners[:, :, 0].min(axis=1) < begin)
        assert 0.8 * steepest < slope[is_here].max() <= steepest


def test_edges_of_friction_are_where_they_are_and_narrow_ones_are_not_missed():
    stripe = {"kind": "patch", "start": 30.0, "length": 0.125, "friction": 0.2}
    for heading in (0.0, 90.0):
        turned = stripe | {"heading": heading, "offset": 0.5}
        mesh = road_mesh(road(turned), PATH, reach=REACH)
        beyond = mesh.friction == 0.2
        across = flat(mesh)[:, :, int(heading == 90.0)]
        first = 30.0 if heading == 0.0 else 0.5
        assert (beyond == ((across >= first) & (across <= first + 0.125)).all(axis=1)).all()
        assert beyond.sum() > 10


def test_a_patch_in_any_direction_is_seen_with_edges_finer_than_the_vehicle():
    """Only beside its edges, along no side of a triangle, may a cell have the other friction."""
    patch = {"kind": "patch", "start": 20.0, "heading": 30.0, "friction": 0.5, "length": 10.0}
    mesh = road_mesh(road(patch), PATH, reach=REACH)
    corners = flat(mesh) - (20.0, 0.0)
    along = corners @ (np.cos(np.radians(30)), np.sin(np.radians(30)))
    near = np.abs(flat(mesh)[:, :, 1]).max(axis=1) < 2.0
    clearly = near & ((along.min(axis=1) > 0.4) & (along.max(axis=1) < 9.6))
    assert clearly.sum() > 50
    assert (mesh.friction[clearly] == 0.5).all()
    outside = near & ((along.max(axis=1) < -0.4) | (along.min(axis=1) > 10.4))
    assert (mesh.friction[outside] == 1.0).all()


@pytest.mark.parametrize("name", ["random profile", "banked curve", "curb"])
def test_a_mesh_keeps_to_its_budget_and_is_the_same_each_time(meshed, name):
    few = road_mesh(ROADS[name], PATH, most_cells=100, reach=REACH)
    middles = len(few.vertices) - len(np.unique(few.triangles[:, 1:]))
    assert middles == 100  # each cell has one vertex that is the first of its triangles only
    again = road_mesh(ROADS[name], PATH, reach=REACH)
    for part in ("vertices", "triangles", "friction", "is_soft"):
        assert getattr(again, part).tobytes() == getattr(meshed[name], part).tobytes()


def test_in_plain_python_only_a_banked_curve_is_coarser_and_close_to_the_path_it_is_as_good(
    meshed,
    monkeypatch,
):
    """Plain Python takes some 8 ms for each of its cells; at the default limit, minutes."""
    monkeypatch.setattr(meshes, "COMPILED", False)
    curve, curb = (road_mesh(ROADS[name], PATH, reach=REACH) for name in ("banked curve", "curb"))
    assert curb.vertices.tobytes() == meshed["curb"].vertices.tobytes()
    middles = len(curve.vertices) - len(np.unique(curve.triangles[:, 1:]))
    assert middles == MOST_IN_PYTHON < len(meshed["banked curve"].vertices) / 2
    points = np.random.default_rng(1).uniform((1.0, -1.5), (58.0, 1.5), (400, 2))
    surface = Triangulation(*curve.vertices[:, :2].T, curve.triangles)
    found = LinearTriInterpolator(surface, curve.vertices[:, 2])(*points.T)
    heights = sampled(ROADS["banked curve"], points)[:, 0]
    assert np.abs(found - heights).max() < 2 * DEVIATION


def test_a_plane_has_no_mesh_whether_it_tilts_or_is_commanded():
    for features in ((), (TILT,), ({"kind": "commanded"},)):
        plane = road(*features)
        assert not has_mesh(plane)
        assert road_mesh(plane, PATH) is None
    assert not has_mesh(None)
    assert not has_heights(None)
    assert road_mesh(road(TILT, FEATURES["dip"]), PATH, most_cells=10) is not None


def test_places_that_are_unknown_are_left_out_and_of_many_as_many_are_kept_as_may_be():
    for unknown in (np.nan, np.inf, 1e300):
        assert road_mesh(ROADS["curb"], np.full((3, 2), unknown)) is None
    long = np.column_stack((np.arange(0.0, 5e4, 0.2), np.zeros(250_000)))
    long[7] = np.nan
    kept = thinned(long)
    assert len(kept) <= MOST_PLACES
    # a place is kept in each piece of a power of two that is as short as the number allows
    assert np.diff(kept[:, 0]).max() <= 2 * 5e4 / MOST_PLACES + 1


def test_features_with_heights_are_those_whose_meshes_have_some(meshed):
    for name, each in ROADS.items():
        assert has_heights(each) == meshed[name].vertices[:, 2].any(), name


@pytest.mark.parametrize("name", ROADS)
def test_the_course_of_a_feature_is_along_its_middle(name):
    (feature,) = (each for each in ROADS[name].features if isinstance(each, Feature))
    course = feature.course()
    assert np.isfinite(course).all()
    length = np.hypot(*np.diff(course, axis=0).T).sum()
    assert 0.0 < length <= 200.0 + 1e-9
    ends = {
        "corkscrew ramp": [[6.0, 0.5], [14.1, 0.5]],  # with its rounding
        "grid": [[5.0, 0.0], [44.0, 0.0]],
        "profile": [[5.0, 0.0], [14.0, 0.0]],
    }
    if name in ends:
        np.testing.assert_allclose(course[[0, -1]], ends[name], atol=1e-12)
    if name == "banked curve":  # two clothoids and an arc, told by chords of 1 m
        assert length == pytest.approx(60.0, abs=0.01)


def test_the_course_of_a_profile_begins_where_its_table_does():
    later = {"kind": "profile", "start": 5.0, "heading": 90.0, "points": [[3, 0], [8, 0.1]]}
    (feature,) = road(later).features
    np.testing.assert_allclose(feature.course()[[0, -1]], [[5.0, 3.0], [5.0, 8.0]], atol=1e-12)
