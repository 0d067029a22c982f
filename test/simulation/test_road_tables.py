"""Profiles and grids from CSV files of their own: the same roads as with the numbers in place."""

import numpy as np
import pytest
from vehicle_files import refused

from vehicle_roll_sim.simulation.road import Road

WRONG = {
    ("profile", "distance;height\n0;0\n"): ("line 1", "separated by semicolons"),
    ("profile", "distance,z\n0,0\n1,1\n"): ("line 1: 'distance,z'", "distance,height or"),
    ("profile", "distance,height\n0,0\n1,one\n"): ("line 3", "numbers"),
    ("profile", "distance,height\n0,0\n"): ("1 rows", "at least two"),
    ("profile", "distance,height\n1,0\n0,0\n"): ("feature 1: points: 2", "beyond 1 m"),
    ("grid", "x,y,height\n0,0,0\n1,0,0\n0,1,0\n"): ("3 rows with 2", "one row for each x"),
    ("grid", "x,y,height\n0,0,0\n0,0,0\n0,1,0\n1,1,0\n"): ("4 rows", "one row for each x"),
    ("grid", "x,y,height\n1,0,0\n2,0,0\n1,1,0\n2,1,0\n"): ("x: 1.0", "from 0 on"),
    ("grid", "x,y,height\n" + "".join(f"{x},{y},0\n" for x in (0, 1, 3) for y in (0, 1))): (
        "from 1 to 2 m",
        "equal distances",
    ),
}


def written(folder, text: str, name: str = "road.yaml"):
    (folder / name).write_text(text)
    return folder / name


def test_a_profile_in_a_file_is_that_with_its_points_in_place(tmp_path):
    written(tmp_path, "distance,left_height,right_height\n0,0,0\n5,0.1,0.2\n9,0,0\n", "both.csv")
    text = "features: [{{kind: profile, start: 3, {}}}]"
    read = Road.from_file(written(tmp_path, text.format("file: both.csv")))
    points = "points: [[0, 0, 0], [5, 0.1, 0.2], [9, 0, 0]]"
    assert read == Road.from_file(written(tmp_path, text.format(points)))


def test_the_rows_of_a_grid_may_come_in_any_order(tmp_path):
    rng = np.random.default_rng(3)
    rows = [
        (0.5 * i, -1.0 + 2.0 * j, *rng.uniform(0.1, 1.0, 2)) for i in range(4) for j in range(3)
    ]
    rng.shuffle(rows)
    lines = "".join(",".join(map(repr, map(float, row))) + "\n" for row in rows)
    written(tmp_path, "x,y,height,friction\n" + lines, "grid.csv")
    road = Road.from_file(written(tmp_path, "features: [{kind: grid, start: 10, file: grid.csv}]"))
    for x, y, height, friction in rows:
        found = road.surface(10.0 + x, y)
        assert (found[0], found[3]) == pytest.approx((height, friction), abs=1e-12)


@pytest.mark.parametrize(("kind", "text"), WRONG)
def test_what_is_wrong_in_a_table_is_refused_with_its_place(tmp_path, kind, text):
    written(tmp_path, text, "table.csv")
    file = written(tmp_path, f"features: [{{kind: {kind}, start: 0, file: table.csv}}]")
    with refused(*WRONG[kind, text]):
        Road.from_file(file)


def test_a_table_and_its_numbers_together_are_refused(tmp_path):
    written(tmp_path, "distance,height\n0,0\n9,0\n", "level.csv")
    both = "features: [{kind: profile, start: 0, file: level.csv, points: [[0, 0], [1, 0]]}]"
    with refused("line 1: feature 1: points", "either this or file, not both"):
        Road.from_file(written(tmp_path, both))
    with refused("feature 1: name: 'file'"):
        Road.from_file(written(tmp_path, "features: [{kind: curb, start: 0, file: level.csv}]"))
