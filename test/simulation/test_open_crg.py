"""Grids from OpenCRG files: heights that are known in closed form, in files written by hand."""

import json
import os
import sys

import numpy as np
import pytest
from crg_files import write_crg
from vehicle_files import refused, write

from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.plausibility import PlausibilityWarning

crg = pytest.importorskip("pyopencrg", reason="OpenCRG files need the library pyopencrg")

ACROSS = np.arange(-1.5, 1.75, 0.5)
ROWS = 41
EXACT = 2e-9
"""m: heights are rounded to 1 nm."""


def road_of(folder, *keys: str) -> Road:
    """A road with a grid; keys: those besides kind and start."""
    feature = ", ".join(["kind: grid", "start: 20", *keys])
    return Road.from_file(write(folder, "road.yaml", f"features: [{{{feature}}}]"))


def wavy(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return 0.05 * np.sin(u)[:, None] + 0.02 * v + 0.004 * u[:, None] * v


U = 0.5 * np.arange(ROWS)
WAVES = wavy(U, ACROSS)


def test_a_straight_file_is_the_grid_of_its_points(tmp_path):
    write_crg(tmp_path / "a.crg", WAVES, 0.5, ACROSS)
    road = road_of(tmp_path, "file: a.crg")
    (grid,) = road.features
    assert (grid.spacing, grid.side_spacing, grid.right, grid.ahead) == (0.5, 0.5, -1.5, 0.0)
    assert np.array(grid.heights) == pytest.approx(WAVES, abs=EXACT)
    assert road.surface(20.0 + 3.5, 0.5)[0] == pytest.approx(WAVES[7, 4], abs=EXACT)
    assert road.surface(20.0 + 99.0, 9.0)[0] == pytest.approx(WAVES[-1, -1], abs=EXACT)  # held
    again = Road.from_values(json.loads(json.dumps(road.values())))
    assert again == road  # a bag needs no file
    assert again.ground().tobytes() == road.ground().tobytes()


def test_the_road_lies_where_the_feature_says_wherever_the_file_has_it(tmp_path):
    """Height and direction are those where its reference line begins."""
    straight = write_crg(tmp_path / "a.crg", WAVES, 0.5, ACROSS)
    turn = 0.7
    placed = ("REFERENCE_LINE_START_X = 300", "REFERENCE_LINE_START_Y = -80")
    turned = (f"REFERENCE_LINE_START_PHI = {turn}", f"REFERENCE_LINE_END_PHI = {turn}")
    phi = np.full(ROWS - 1, turn)
    header = (*placed, *turned, "REFERENCE_LINE_START_Z = 120")
    write_crg(tmp_path / "b.crg", WAVES, 0.5, ACROSS, phi=phi, header=header, modifiers=())
    one, two = (road_of(tmp_path, f"file: {name}").features[0] for name in (straight.name, "b.crg"))
    assert np.array(two.heights) == pytest.approx(np.array(one.heights), abs=EXACT)
    assert (two.spacing, two.right, two.ahead) == (one.spacing, one.right, one.ahead)


def test_slope_and_banking_of_the_reference_line_are_part_of_the_heights(tmp_path):
    slope, bank = 0.03 * np.cos(U[1:]), 0.02 * np.sin(U / 4)
    write_crg(tmp_path / "a.crg", WAVES, 0.5, ACROSS, slope=slope, bank=bank)
    (grid,) = road_of(tmp_path, "file: a.crg").features
    line = np.concatenate(([0.0], np.cumsum(0.5 * slope)))
    expected = WAVES + line[:, None] + bank[:, None] * ACROSS
    assert np.array(grid.heights) == pytest.approx(expected, abs=EXACT)


def test_the_file_that_the_library_writes_in_binary_is_the_same_road(tmp_path):
    write_crg(tmp_path / "a.crg", WAVES, 0.5, ACROSS)
    crg.CrgRoad(z=WAVES, u_inc=0.5, v=ACROSS).save(tmp_path / "b.crg", fmt="KDBI")
    assert road_of(tmp_path, "file: a.crg") == road_of(tmp_path, "file: b.crg")


def test_columns_at_uneven_distances_are_taken_at_the_smallest_of_them(tmp_path):
    across = np.array([-1.5, -1.25, -1.0, 0.0, 1.0, 1.25, 1.5])
    write_crg(tmp_path / "a.crg", wavy(U, across), 0.5, across)
    (grid,) = road_of(tmp_path, "file: a.crg").features
    at = np.arange(-1.5, 1.6, 0.25)  # the heights are straight across, so nothing is lost
    assert grid.side_spacing == 0.25
    assert np.array(grid.heights) == pytest.approx(wavy(U, at), abs=EXACT)


def test_a_grid_that_is_coarser_than_its_file_has_means(tmp_path):
    """Of a comb: the points of every fourth row are 0.05 m low, the mean is 0 everywhere."""
    comb = np.where(np.arange(ROWS) % 2, 0.05, -0.05)[:, None] + 0.02 * ACROSS
    write_crg(tmp_path / "a.crg", comb, 0.5, ACROSS)
    (grid,) = road_of(tmp_path, "file: a.crg", "spacing: 2", "side_spacing: 0.25").features
    heights = np.array(grid.heights)
    assert heights.shape == (11, 13)
    inside = 0.05 + 0.02 * np.linspace(-1.5, 1.5, 13)  # over the beginning, which is a low row
    assert heights[1:-1] == pytest.approx(np.tile(inside, (9, 1)), abs=EXACT)


CHORD, BANK = 0.8, 0.04


def arc(path, radius: float, count: int, header=()) -> None:
    """A road of `count` chords to the left, or to the right if the radius is negative.

    Its height is that of the banking alone.
    """
    phi = (np.arange(count) + 0.5) * CHORD / radius
    heights, bank = np.zeros((count + 1, len(ACROSS))), [BANK] * (count + 1)
    write_crg(path, heights, CHORD, ACROSS, phi=phi, bank=bank, header=header)


def height(road: Road, radius: float, angle: float, v: float) -> float:
    """Of a place on an arc at v, after an angle along it. The grid lies along the first chord."""
    x, y = (abs(radius) - np.sign(radius) * v) * np.array([np.sin(angle), np.cos(angle)])
    place = complex(x, np.sign(radius) * (abs(radius) - y)) * np.exp(-0.5j * CHORD / radius)
    return road.surface(20.0 + place.real, place.imag)[0]


@pytest.mark.parametrize("radius", [40.0, -40.0])
def test_a_curved_road_has_the_heights_of_its_own_coordinates(tmp_path, radius):
    """Along an arc v is the distance from it, of which chords of 0.8 m miss 2 mm: 0.08 mm high."""
    arc(tmp_path / "a.crg", radius, 80)
    road = road_of(tmp_path, "file: a.crg", "spacing: 0.25", "side_spacing: 0.25")
    angles = np.linspace(0.05, 1.55, 60)
    for v in (-0.9, -0.3, 0.0, 0.8):
        heights = [height(road, radius, angle, v) for angle in angles]
        assert heights == pytest.approx([BANK * v] * 60, abs=1e-4)


def test_behind_its_end_a_curved_road_goes_on_straight_as_at_its_edge(tmp_path):
    """Also where the file does not say in which direction it ends."""
    angle, roads = 60 * CHORD / 40.0, []
    for header in ([], [f"REFERENCE_LINE_END_PHI = {angle - 0.5 * CHORD / 40.0}"]):
        arc(tmp_path / "a.crg", 40.0, 60, header)
        roads.append(road_of(tmp_path, "file: a.crg", "spacing: 0.25", "side_spacing: 0.25"))
    assert roads[0] == roads[1]
    for v in (-0.6, 0.0, 0.6):  # 0.4 m behind it; the last chord is 0.02 rad from the arc there
        assert height(roads[0], 40.0, angle + 0.01, v) == pytest.approx(BANK * v, abs=8e-4)
    assert roads[0].surface(20.0 + 99.0, 99.0)[0] == roads[0].features[0].heights[-1][-1]


def test_a_road_that_turns_back_has_rows_behind_its_start(tmp_path):
    arc(tmp_path / "a.crg", 10.0, 60)
    road = road_of(tmp_path, "file: a.crg", "side_spacing: 0.25", "spacing: 0.25")
    behind = 11.5 - 10.0 * np.sin(0.04)  # radius and half of the width, seen from the first chord
    assert road.features[0].ahead == pytest.approx(-behind, abs=0.02)
    for angle in np.linspace(0.2, 4.6, 23):  # chords of 0.8 m miss 8 mm
        assert height(road, 10.0, angle, 0.6) == pytest.approx(0.6 * BANK, abs=4e-4)


def test_the_border_modes_of_a_file_do_not_apply(tmp_path):
    """A grid that reaches beyond the data has the heights of the edge there."""
    options = ["$", "$ROAD_CRG_OPTS", "BORDER_MODE_U = 0", "BORDER_MODE_V = 0"]
    heights = np.zeros_like(WAVES) + 0.1 * (np.arange(ROWS) == ROWS - 1)[:, None]
    write_crg(tmp_path / "a.crg", heights, 0.5, ACROSS, header=options)
    (grid,) = road_of(tmp_path, "file: a.crg", "spacing: 0.45", "side_spacing: 0.4").features
    assert grid.heights[-1] == pytest.approx([0.1] * 9, abs=EXACT)


def test_friction_comes_from_a_file_with_the_same_reference_line(tmp_path):
    frictions = 0.6 + 0.2 * np.cos(U)[:, None] + 0.1 * ACROSS
    write_crg(tmp_path / "a.crg", WAVES, 0.5, ACROSS)
    write_crg(tmp_path / "mu.crg", frictions, 0.5, ACROSS)
    road = road_of(tmp_path, "file: a.crg", "friction_file: mu.crg")
    assert np.array(road.features[0].frictions) == pytest.approx(frictions, abs=EXACT)
    assert road.surface(20.0 + 2.0, -1.0)[3] == pytest.approx(frictions[4, 1], abs=EXACT)
    write_crg(tmp_path / "mu.crg", frictions[:-1], 0.5, ACROSS)
    with refused("mu.crg: another reference line", "that of", "a.crg"):
        road_of(tmp_path, "file: a.crg", "friction_file: mu.crg")
    write_crg(tmp_path / "mu.crg", frictions - 1.0, 0.5, ACROSS)
    with refused("line 1: feature 1: frictions: -", "numbers from 0 to"):
        road_of(tmp_path, "file: a.crg", "friction_file: mu.crg")


GAP = WAVES.copy()
GAP[7, 3] = np.nan
EDGE = WAVES.copy()
EDGE[7:9, :2] = np.nan


def test_heights_may_be_missing_at_the_edges_where_the_next_ones_are_held(tmp_path):
    write_crg(tmp_path / "a.crg", EDGE, 0.5, ACROSS)
    heights = np.array(road_of(tmp_path, "file: a.crg").features[0].heights)
    assert heights[7, :3] == pytest.approx([WAVES[7, 2]] * 3, abs=EXACT)
    write_crg(tmp_path / "a.crg", EDGE, 0.5, ACROSS, modifiers=["GRID_NAN_MODE = 0"])
    with refused("a.crg: heights are missing at u = 3.5 m", "only with GRID_NAN_MODE 1 or 2"):
        road_of(tmp_path, "file: a.crg")


def test_what_is_wrong_in_a_file_is_refused_in_one_line(tmp_path):
    good = write_crg(tmp_path / "a.crg", WAVES, 0.5, ACROSS).read_text()

    def check(text: str, *said: str):
        (tmp_path / "a.crg").write_text(text)
        with refused("a.crg", *said):
            road_of(tmp_path, "file: a.crg")

    check("", "no $KD_DEFINITION block found")
    check("x,y,height\n0,0,0\n", "no $KD_DEFINITION block found")
    check(good.replace("long section", "short section"), "at least 2 long sections")
    check(good[: len(good) * 2 // 3], "unexpected end of text data")
    check(good.replace("LDFI", "XXXX"), "data format 'XXXX' is not supported")
    check(good.replace("e-02 ", "e-0x "), "unreadable value(s)")
    check(good.replace("-1.500,m", "-1.500,km"), "unit of 'long section at v = -1.500'")
    check(good.replace("INCREMENT = 0.5", "INCREMENT = -0.5"), "illegal increment along u: -0.5")
    narrow = write_crg(tmp_path / "a.crg", WAVES, 0.5, ACROSS, modifiers=["SCALE_WIDTH = 1e-30"])
    check(narrow.read_text(), "no finite size")
    referring = good[: good.index("$KD_DEF")] + "$ROAD_CRG_FILE\nnone.crg\n$\n"
    check(referring, "does not exist", "none.crg: give the name of an existing file")
    write_crg(tmp_path / "gap.crg", GAP, 0.5, ACROSS)
    check((tmp_path / "gap.crg").read_text(), "heights are missing at u = 3.5 m")


def test_what_is_doubtful_in_a_file_is_said_in_one_line_each(tmp_path):
    def check(doubt: str, spacing: float, phi=None):
        write_crg(tmp_path / "a.crg", WAVES, spacing, ACROSS, phi=phi)
        with pytest.warns(PlausibilityWarning, match=rf"a\.crg: {doubt}") as said:
            road_of(tmp_path, "file: a.crg")
        assert all(len(str(each.message).splitlines()) == 1 for each in said)

    check("u increment = 0.7853 is not a multiple", 0.7853)
    for side in (1.0, -1.0):  # a radius of 1 m, less than half of the width
        check("curvature too high", 0.5, side * np.arange(ROWS - 1) * 0.5)


def test_keys_that_do_not_go_with_a_file_are_refused(tmp_path):
    write_crg(tmp_path / "a.crg", WAVES, 0.5, ACROSS)
    for keys, said in {
        ("file: none.crg",): "No such file or directory: give the name of an existing file",
        ("file: .crg",): "give the name of a",
        ("file: 3",): "line 1: feature 1: file: 3",
        ("file: a.crg", "right: 1"): "feature 1: right: 1 is not allowed: either this or file",
        ("file: a.crg", "friction_file: 3"): "feature 1: friction_file: 3",
        ("file: a.crg", "friction_file: none.crg"): "none.crg: No such file",
        ("file: a.crg", "spacing: 0"): "feature 1: spacing: 0",
        ("file: a.crg", "spacing: soon"): "feature 1: spacing: 'soon'",
        ("file: a.csv", "friction_file: a.crg"): "a.csv",
    }.items():
        with refused(said):
            road_of(tmp_path, *keys)


def test_too_many_points_are_refused_with_a_spacing_that_fits(tmp_path):
    write_crg(tmp_path / "a.crg", WAVES, 0.5, ACROSS)
    keys = ["file: a.crg", "spacing: 0.01", "side_spacing: 0.01"]
    with refused("a.crg: 2001 x 301 points: at most 200000, as with spacing and side_spacing of"):
        road_of(tmp_path, *keys)
    assert road_of(tmp_path, "file: a.crg", "spacing: 0.019", "side_spacing: 0.019")
    os.truncate(tmp_path / "a.crg", 2_000_000_000)  # without blocks on the disk
    with refused("a.crg: it has 2000000000 bytes: at most 1000000000 bytes"):
        road_of(tmp_path, "file: a.crg")


def test_without_the_library_it_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyopencrg", None)
    with refused("a.crg: no Python package pyopencrg: pip install 'vehicle_roll_sim[crg]'"):
        road_of(tmp_path, "file: a.crg")
