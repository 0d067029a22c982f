"""Road files: what is in them is the road, and everything else is refused in one line."""

import json

import numpy as np
import pytest
from road_kinds import FEATURES, ROADS, TILT, road
from vehicle_files import refused, write

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.roads.kinds import KINDS
from vehicle_roll_sim.simulation.road import Road

FILE = """\
grade: 0.02
features:
  - kind: patch     # split friction
    start: 20
    left: 0
    friction: 0.3
  - kind: curb
    start: 40
    offset: 1.5
    raised: left
"""
WRONG = {
    "grad: 0.1": ("line 1", "did you mean grade?"),
    "grade: 2": ("line 1: grade: 2", "from -1 to 1 m/m"),
    "features: 3": ("line 1: features", "a list of features"),
    "features: {}": ("line 1: features", "a list of features"),
    "features: false": ("line 1: features: False", "a list of features"),
    "features: [3]": ("line 1: feature 1", "a mapping with kind"),
    "features: [{start: 3}]": ("feature 1: kind: missing", "one of patch, chessboard"),
    "features: [{kind: cub}]": ("feature 1: kind", "did you mean curb?"),
    "features: [{kind: curb}]": ("feature 1: start: missing", "all are required"),
    "features: [{kind: curb, start: 0, heigth: 1}]": ("feature 1: name", "did you mean height?"),
    "features: [{kind: curb, start: 0, height: 9}]": ("feature 1: height: 9", "from 0.01 to 1 m"),
    "features: [{kind: curb, start: 0, length: 0.2}]": ("length: 0.2", "four times its rounding"),
    "features: [{kind: patch, start: 0, friction: -1}]": ("friction: -1", "a number from 0"),
    "features: [{kind: patch, start: 0, friction: 1, left: 0, right: 1}]": ("right: 1", "less tha"),
    "features: [{kind: wave, start: 0, length: 1, height: 1, count: 1.5}]": ("count", "a whole nu"),
    "features: [{kind: banked_curve, start: 0, radius: 5, arc: 9, bank: 0}]": ("radius", "12 m"),
    "features: [{kind: profile, start: 0, points: [[0, 0], [0, 1]]}]": ("points: 2", "beyond 0"),
    "features: [{kind: profile, start: 0, points: [[0, 0], [.nan, 1]]}]": ("points: 2", "finite"),
    "features: [{kind: profile, start: 0, points: 3}]": ("points: 3", "2 to 200000 lists"),
    "features: [{kind: profile, start: 0}]": ("points: missing", "2 to 200000 lists"),
    "features: [{kind: grid, start: 0, spacing: 1, side_spacing: 1, right: 0, "
    "heights: [[1, 2]]}]": ("heights: a table of 1 x 2", "2 or more rows"),
    "features: [{kind: grid, start: 0, spacing: 1, side_spacing: 1, right: 0, "
    "heights: [[0, 0], [0, true]]}]": ("heights: True", "a number"),
    "features: [{kind: grid, start: 0, spacing: 1, side_spacing: 1, right: 0, "
    "heights: [['0', 0], [0, 0]]}]": ("heights: '0'", "a number"),
    "features: [{kind: grid, start: 0, spacing: 1, side_spacing: 1, right: 0, "
    "heights: [[0, 0], [0]]}]": ("heights: not a table", "all of a length"),
    "features: [{kind: grid, start: 0, spacing: 1, side_spacing: 1, right: 0, heights: 3}]": (
        "heights: not a table",
        "2 or more rows",
    ),
    "features: [{kind: random_profile, start: 0, roughness: Z}]": ("roughness: 'Z'", "A, B, C"),
    "features: [{kind: random_profile, start: 0, spacing: 0.2}]": ("spacing: 0.2", "at most 0.175"),
    "features: [{kind: commanded, start: 0}]": ("name: 'start' is unknown", "there are none"),
    "features: [{kind: tilt_table, angles: [[0, 0], [1, 95]]}]": ("angles", "from -89 to 89 deg"),
    "grade: 0.1\nfeatures: [{kind: tilt_table, angles: [[0, 0], [1, 5]]}]": (
        "line 1: grade: 0.1",
        "0 on a tilt table",
    ),
    "features: [{kind: commanded}, {kind: chessboard, start: 0, friction: 1, other_friction: 0, "
    "square_length: 1, square_width: 1}]": ("feature 2: left: missing", "squares are counted"),
    "- kind: curb": ("road file", "a YAML mapping with grade, bank and features"),
}


def test_a_road_file_gives_its_slopes_and_features(tmp_path):
    read = Road.from_file(write(tmp_path, "road.yaml", FILE))
    patch, curb = read.features
    assert (read.grade, read.bank) == (0.02, 0.0)
    assert (patch.start, patch.left, patch.right, patch.friction) == (20.0, 0.0, None, 0.3)
    assert (curb.offset, curb.raised, curb.height) == (1.5, "left", 0.15)
    assert read.surface(25.0, -1.0)[3] == 0.3
    assert read.surface(50.0, 3.0)[0] == pytest.approx(0.15)


@pytest.mark.parametrize("text", WRONG)
def test_what_is_wrong_in_a_road_file_is_refused_with_its_place(tmp_path, text):
    with refused("road.yaml", *WRONG[text]):
        Road.from_file(write(tmp_path, "road.yaml", text))


def test_a_file_that_is_not_there_is_named():
    with refused("none.yaml", "No such file"):
        Road.from_file("none.yaml")


@pytest.mark.parametrize("name", ROADS)
def test_a_road_is_rebuilt_from_its_values_even_as_json(name):
    values = json.loads(json.dumps(ROADS[name].values()))
    again = Road.from_values(values)
    assert again == ROADS[name]
    assert again.ground().tobytes() == ROADS[name].ground().tobytes()
    assert hash(again) == hash(ROADS[name])


def test_every_kind_has_been_tried():
    kinds = {feature["kind"] for feature in FEATURES.values()}
    assert kinds | {"tilt_table", "commanded"} == {*KINDS}


def test_a_plane_has_the_values_that_it_always_had():
    assert Road(0.1, -0.2).values() == {"grade": 0.1, "bank": -0.2}
    assert not Road().ground().any()


@pytest.mark.parametrize("model", ["8dof", "8dof-rigid-tires"])
def test_a_model_without_vertical_wheel_motion_has_planes_only(model):
    with refused("road: features on the road of model " + model, "use model 1 or 2"):
        Simulation(preset(), Options(model), road=ROADS["ramp"])


def test_tires_that_stay_normal_to_the_ground_have_planes_only():
    with refused("tire_normal_to_ground: not possible on a road with features", "for planes"):
        Simulation(preset(), Options(tire_normal_to_ground=True), road=ROADS["ramp"])


@pytest.mark.parametrize("features", [3, (3,), ({"kind": "curb"},), (ROADS["ramp"],)])
def test_features_are_objects(features):
    with refused("features", "feature"):
        Road(features=features)


def test_two_tilt_tables_are_refused():
    with refused("features: two tilt tables", "at most one"):
        road(TILT, TILT)


@pytest.mark.parametrize(
    ("values", "fault"),
    [
        ({"features": 3}, "features: 3"),
        ({"features": {}}, "features: {}"),
        ({"feature": []}, "did you mean features?"),
        (3, "road: 3"),
    ],
)
def test_values_that_are_no_road_are_refused(values, fault):
    with refused(fault):
        Road.from_values(values)


def test_features_without_a_value_are_none():
    assert Road.from_values({"features": None}) == Road()


def test_no_wheel_starts_with_its_centre_in_the_ground():
    """The left wheels on the top of a curb, which is higher than their centres, or lower."""
    curb = {"kind": "curb", "start": -20, "length": 50, "raised": "left"}
    high, low = (Simulation(preset(), road=road(curb | {"height": h})) for h in (1.0, 0.1))
    with refused("road: 1 m high under the wheel lf at the start", "less than the height"):
        high.reset(10.0)
    low.reset(10.0)


def test_another_road_is_another_simulation_for_a_snapshot():
    first, second = (Simulation(preset(), road=ROADS[name]) for name in ("ramp", "dip"))
    snapshot = first.snapshot()
    first.restore(snapshot)
    with refused("snapshot", "the same vehicle, options, road"):
        second.restore(snapshot)


def test_a_profile_follows_its_points_and_is_averaged_over_the_contact_patch():
    points = [[0, 0.0], [10, 0.0], [10.05, 0.1], [20, 0.1]]
    for length, expected in ((0.0, 0.0), (0.5, 0.05 - 0.05 * 0.05)):
        found = road({"kind": "profile", "start": 5, "points": points, "contact_length": length})
        assert found.surface(15.0, 0.0)[0] == pytest.approx(expected, abs=3e-3)
        assert found.surface(24.0, 0.0)[0] == pytest.approx(0.1)
    both = road({"kind": "profile", "start": 0, "points": [[0, 0.2, 0.1], [9, 0.2, 0.1]]})
    heights = [both.surface(4.0, y)[0] for y in (2.0, 0.75, 0.0, -0.75, -2.0)]
    assert heights == pytest.approx([0.2, 0.2, 0.15, 0.1, 0.1])
    assert np.abs([both.surface(4.0, y)[2] for y in (2.0, 0.75, -0.75)]).max() < 1e-12


@pytest.mark.parametrize("length", [0.0, 0.1, 0.13, 2.0])
def test_beyond_its_ends_a_profile_is_as_high_as_its_first_and_last_point(length):
    """A bump of which the ends are kinks: their means are those over a straight line and a level.

    The mean over the length L about the kink of a slope a is a L / 8 of the height there.
    """
    slope, points = 0.02, [[0, 0.0], [5, 0.1], [10, 0.04]]
    found = road({"kind": "profile", "start": 20, "points": points, "contact_length": length})
    far = length / 2 + 0.06  # the table has points at 0.05 m
    for place, height in ((0.0, 0.0), (20 - far, 0.0), (30 + far, 0.04), (100.0, 0.04)):
        assert found.surface(place, 0.0)[:2] == pytest.approx((height, 0.0), abs=1e-12)
    assert found.surface(20.0, 0.0)[0] == pytest.approx(slope * length / 8, abs=1e-12)


@pytest.mark.parametrize("at", [5.0, 5.01, 5.025, 5.04])
def test_an_obstacle_of_a_profile_counts_with_its_area_wherever_its_table_has_points(at):
    """2 cm high and 5 cm long, among points of the table at 5 cm: half as high, over 15 cm."""
    edge = 0.001
    points = [[0, 0], [at, 0], [at + edge, 0.02], [at + 0.05, 0.02], [at + 0.05 + edge, 0], [9, 0]]
    found = road({"kind": "profile", "start": 0, "points": points})
    places = np.linspace(4.5, 5.5, 2001)
    heights = np.array([found.surface(x, 0.0)[0] for x in places])
    area = 0.02 * 0.05
    # means over a whole number of spacings keep the area; heights are sampled at 0.5 mm
    assert np.trapezoid(heights, places) == pytest.approx(area, rel=1e-4)
    assert heights.max() == pytest.approx(area / 0.1, rel=0.15)  # cubic curves overshoot
    assert np.ptp(places[heights > 1e-4]) == pytest.approx(0.15, abs=0.05)  # one point more or less
