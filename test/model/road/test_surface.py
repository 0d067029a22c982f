"""The surface of a road: its slopes are those of its heights, and its shapes are those declared."""

import math

import numpy as np
import pytest
from road_kinds import ROADS, TILT, road
from scipy.integrate import quad

from vehicle_roll_sim.model.road.surface import tilt_angle

DIFFERENCE = 1e-6
"""m"""
CURVED = 1e-7
"""m/m: of the central difference, and of rounding."""
ROUNDING = 1e-12


def points(count: int = 300) -> np.ndarray:
    rng = np.random.default_rng(1)
    return np.column_stack((rng.uniform(0.0, 50.0, count), rng.uniform(-3.0, 3.0, count)))


@pytest.mark.parametrize("name", ROADS)
def test_the_slopes_of_a_road_are_those_of_its_heights(name):
    surface, h = ROADS[name].surface, DIFFERENCE
    for x, y in points():
        _, along, across, _ = surface(x, y)
        ahead, back = surface(x + h, y)[0], surface(x - h, y)[0]
        left, right = surface(x, y + h)[0], surface(x, y - h)[0]
        assert along == pytest.approx((ahead - back) / (2 * h), abs=CURVED * (1 + abs(along)))
        assert across == pytest.approx((left - right) / (2 * h), abs=CURVED * (1 + abs(across)))


@pytest.mark.parametrize("name", ROADS)
def test_a_feature_that_is_turned_and_moved_is_the_same_there(name):
    (feature,) = ROADS[name].values()["features"]
    angle, moved = math.radians(30.0), dict(feature)
    x0, y0 = feature["start"], feature.get("offset", 0.0)
    moved["heading"] = 30.0
    turned = road(moved)
    for x, y in points(50):
        s, n = x - x0, y - y0
        there = (
            x0 + s * math.cos(angle) - n * math.sin(angle),
            y0 + s * math.sin(angle) + n * math.cos(angle),
        )
        height, _, _, friction = ROADS[name].surface(x, y)
        again = turned.surface(*there)
        assert again[0] == pytest.approx(height, abs=1e-9)  # the curve: its table is by 1 m
        if name not in ("patch", "chessboard"):  # a point on an edge may be on either side of it
            assert again[3] == pytest.approx(friction, abs=ROUNDING)


def test_a_ramp_rises_by_its_height_with_the_slope_of_a_straight_line_between_rounded_ends():
    steep = road({"kind": "ramp", "start": 10.0, "length": 4.0, "height": 1.0, "rounding": 0.5})
    assert steep.surface(9.9, 0.0)[:3] == (0.0, 0.0, 0.0)
    assert steep.surface(12.0, 1.0)[0] == pytest.approx(0.5, abs=ROUNDING)
    assert steep.surface(12.0, 1.0)[1] == pytest.approx(1.0 / 3.5, abs=ROUNDING)
    assert steep.surface(100.0, 0.0)[:3] == (1.0, 0.0, 0.0)


def test_only_one_side_of_a_corkscrew_ramp_rises():
    for raised, side in (("left", 1.0), ("right", -1.0)):
        ramp = {"kind": "corkscrew_ramp", "start": 0.0, "length": 5.0, "height": 0.6}
        surface = road({**ramp, "width": 2.0, "top": 1.0, "raised": raised}).surface
        assert surface(5.5, -side)[0] == 0.0
        assert surface(5.5, side)[0] == pytest.approx(0.3, abs=ROUNDING)
        assert surface(5.5, 3 * side)[0] == pytest.approx(0.6, abs=ROUNDING)
        assert surface(7.0, 3 * side)[0] == 0.0


def test_a_curb_has_the_angle_of_its_face_and_the_height_of_its_top():
    curb = {"kind": "curb", "start": 0.0, "length": 50.0, "height": 0.2, "face_angle": 30.0}
    for raised, side in (("left", 1.0), ("right", -1.0)):
        surface = road({**curb, "raised": raised, "rounding": 0.02}).surface
        face = 0.2 / math.tan(math.radians(30.0)) + 0.02
        assert surface(25.0, -0.01 * side)[0] == 0.0
        assert surface(25.0, side * face / 2)[2] == pytest.approx(side * math.tan(math.pi / 6))
        assert surface(25.0, 2.0 * side)[0] == pytest.approx(0.2, abs=ROUNDING)


def test_crests_have_their_height_in_their_middle_and_follow_each_other():
    surface = road({"kind": "wave", "start": 5.0, "length": 4.0, "height": 0.2, "count": 2}).surface
    assert [surface(x, 0.0)[0] for x in (7.0, 11.0)] == pytest.approx([0.2, 0.2])
    assert [surface(x, 0.0)[0] for x in (9.0, 13.5)] == pytest.approx([0.0, 0.0])


def test_the_centreline_of_a_banked_curve_is_a_clothoid_and_then_a_circle():
    """By quadrature of its heading, and by the distance from the centre of the circle."""
    radius, transition = 60.0, 15.0
    curve = {"kind": "banked_curve", "start": 0.0, "radius": radius, "arc": 30.0, "width": 10.0}
    surface = road({**curve, "transition": transition, "bank": 0.2}).surface

    def heading(s):
        return s * s / (2 * radius * transition)

    x = quad(lambda s: math.cos(heading(s)), 0.0, transition, epsabs=1e-13)[0]
    y = quad(lambda s: math.sin(heading(s)), 0.0, transition, epsabs=1e-13)[0]
    end = heading(transition)
    assert surface(x, y)[0] == pytest.approx(0.0, abs=1e-9)
    centre = np.array([x - radius * math.sin(end), y + radius * math.cos(end)])
    for angle in np.linspace(end + 0.05, end + 0.45, 7):
        outwards = np.array([math.sin(angle), -math.cos(angle)])
        for aside in (-3.0, 0.0, 3.0):
            place = centre + (radius + aside) * outwards
            height, along, across, _ = surface(*place)
            assert height == pytest.approx(0.2 * aside, abs=1e-8)  # the outer side is raised
            assert np.array([along, across]) == pytest.approx(0.2 * outwards, abs=1e-7)


def test_friction_is_that_of_the_patch_or_the_square_and_otherwise_1():
    surface = ROADS["patch"].surface
    assert [surface(x, y)[3] for x, y in ((7.9, -1), (8.1, -1), (8.1, 1))] == [1.0, 0.3, 1.0]
    surface = ROADS["chessboard"].surface
    first, beside = surface(5.5, -3.5)[3], surface(5.5, -2.5)[3]
    assert (first, beside, surface(7.5, -3.5)[3], surface(7.5, -2.5)[3]) == (1.0, 0.4, 0.4, 1.0)
    assert surface(4.9, 0.0)[3] == 1.0


def test_frictions_of_features_are_multiplied_and_heights_are_added():
    both = road(
        {"kind": "patch", "start": 0.0, "friction": 0.5},
        {"kind": "patch", "start": 0.0, "friction": 0.4},
        {"kind": "wave", "start": 0.0, "length": 4.0, "height": 0.2},
        {"kind": "ramp", "start": -5.0, "length": 4.0, "height": 1.0},
    )
    height, _, _, friction = both.surface(2.0, 0.0)
    assert height == pytest.approx(1.2)
    assert friction == pytest.approx(0.2)


def test_a_grid_has_the_heights_and_frictions_of_its_points_and_keeps_those_of_its_edge():
    heights = np.random.default_rng(2).uniform(0.0, 1.0, (5, 4))
    grid = {"kind": "grid", "start": 10.0, "spacing": 2.0, "side_spacing": 0.5, "right": -1.0}
    surface = road({**grid, "heights": heights.tolist(), "frictions": heights.tolist()}).surface
    for row in range(5):
        for column in range(4):
            found = surface(10.0 + 2.0 * row, -1.0 + 0.5 * column)
            assert found[0] == pytest.approx(heights[row, column], abs=ROUNDING)
            assert found[3] == pytest.approx(heights[row, column], abs=ROUNDING)
    assert surface(11.0, -1.0)[3] == pytest.approx(heights[:2, 0].mean())
    assert surface(0.0, -9.0)[0] == pytest.approx(heights[0, 0])


def test_a_place_that_is_not_a_number_is_not_looked_up_outside_a_table():
    """Along the grid; across it the place is then unknown, and its right edge is taken."""
    heights = [[1.0 + row, 9.0] for row in range(5)]
    grid = {"kind": "grid", "start": 0.0, "spacing": 0.5, "side_spacing": 1.0, "right": 0.0}
    surface = road({**grid, "heights": heights, "frictions": heights}).surface
    for place, expected in ((math.nan, 1.0), (-math.inf, 1.0), (math.inf, 5.0)):
        height, *_, friction = surface(place, 0.0)
        assert (height, friction) == (expected, expected)


def test_the_angle_of_a_tilt_table_is_that_of_its_table():
    ground = road(TILT).ground()
    angles = [math.degrees(tilt_angle(time, ground)) for time in (-1.0, 0.5, 5.25, 10.0, 20.0)]
    assert angles == pytest.approx([0.0, 0.0, 9.5, 19.0, 19.0])
