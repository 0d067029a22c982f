"""What a page is told of the road of its runs."""

import base64
import json

import numpy as np
import pytest
from test_live_run import ANGLE, KnownToAPage
from test_page import columns_of, data_of
from viewed_runs import ROAD, fishhook, of_columns, over_crests, scene, viewed

from vehicle_roll_sim import preset
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.road_mesh import road_mesh
from vehicle_roll_sim.viewer.live_run import MESH_EVERY, LiveRun
from vehicle_roll_sim.viewer.page import page
from vehicle_roll_sim.viewer.road import LEAST_CELLS, values_of_mesh

LARGEST = 400_000
"""Characters of a road: see docs/viewer.md."""


def numbers_of(told: dict, name: str, kind: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(told[name]), kind)


@pytest.fixture(scope="module")
def told() -> dict:
    return data_of(page([viewed(over_crests()), viewed(fishhook())], "two"))


def test_each_run_has_its_road_and_the_road_its_mesh(told):
    assert told["on"] == [0, None]
    (road,) = told["roads"]
    history = over_crests().history
    mesh = road_mesh(ROAD, np.column_stack((history["x"], history["y"])))
    vertices = numbers_of(road, "vertices", "<f4").reshape(-1, 3)
    np.testing.assert_array_equal(vertices, mesh.vertices.astype("f4"))
    triangles = numbers_of(road, "triangles", "<u2").reshape(-1, 3)
    np.testing.assert_array_equal(triangles, mesh.triangles)
    assert set(numbers_of(road, "friction", "<u2")) == {0, 100}
    assert not numbers_of(road, "soft", "u1").any()


def test_a_run_knows_the_heights_under_it_and_the_angle_of_its_table(told):
    on_road, on_plane = (columns_of(each) for each in told["runs"])
    history = over_crests().history
    heights = [ROAD.surface(x, y)[0] for x, y in zip(history["x"], history["y"], strict=True)]
    np.testing.assert_allclose(on_road["ground"], heights, rtol=1e-6, atol=1e-9)  # 32 bits
    ahead, aside = preset().cg_to_front_axle, preset().front_track / 2
    x = history["x"] + ahead * np.cos(history["yaw"]) - aside * np.sin(history["yaw"])
    front = [ROAD.surface(each, 0.0)[0] for each in x]  # crests across, so y changes nothing
    np.testing.assert_allclose(on_road["ground_lf"], front, rtol=1e-5, atol=1e-6)
    expected = np.radians(np.interp(history["time"], [0.5, 1.0], [0.0, 15.0]))
    np.testing.assert_allclose(on_road["tilt"], expected, rtol=1e-6)
    assert not {"ground", "tilt"} & on_plane.keys()


def test_runs_on_the_same_road_share_its_mesh_and_many_roads_share_the_budget():
    same = Road.from_values(ROAD.values())
    runs = [viewed(over_crests())] * 2
    assert len(data_of(page(runs, ""))["roads"]) == 1
    assert data_of(page(runs, ""))["on"] == [0, 0]
    assert same == ROAD
    others = [
        Road.from_values({"features": [{"kind": "random_profile", "start": 0, "seed": seed}]})
        for seed in range(20)
    ]
    history, events = over_crests().history, over_crests().events
    many = [type(runs[0])(history, events, "", scene(), road) for road in others]
    found = data_of(page(many, ""))["roads"]
    assert len(found) == 20
    for each in found:  # two vertices of a cell, and its share of those of the border
        assert len(numbers_of(each, "vertices", "<f4")) / 3 < 2.5 * LEAST_CELLS


def test_a_road_has_at_most_the_size_that_is_stated():
    rough = {"kind": "random_profile", "start": 0, "roughness": "H"}
    path = np.column_stack((np.linspace(0, 300, 400), np.zeros(400)))
    mesh = road_mesh(Road.from_values({"features": [rough]}), path)
    assert len(json.dumps(values_of_mesh(mesh))) < LARGEST


def test_a_page_that_follows_is_told_the_road_again_only_when_it_has_gone_on():
    live = LiveRun("a run", scene(), ANGLE, ROAD)
    known, had = None, []
    for x in (0.0, 0.5 * MESH_EVERY, 1.5 * MESH_EVERY, 1.6 * MESH_EVERY):
        added = of_columns(2, x=x)
        added.rows[:, 0] += x
        live.add(added)
        known = known or KnownToAPage(live)
        had.append(known.take().get("road"))
    assert [bool(each) for each in had] == [True, False, True, False]
    assert had[0] != had[2]
    assert data_of(live.page("/updates"))["roads"] == [had[2]]
    elsewhere = LiveRun("a run", scene(), ANGLE)
    elsewhere.add(of_columns(2))
    assert KnownToAPage(elsewhere).take()["road"] is None
