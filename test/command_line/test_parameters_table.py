"""`parameters`: a Markdown table of every parameter of a vehicle."""

import pytest
import yaml

from vehicle_roll_sim.vehicle.vehicle_file import PRESETS

REFERENCE = yaml.safe_load((PRESETS / "reference.yaml").read_text())
OPTIONAL = {
    "minimum_relaxation_length": 0.1,
    "rolling_resistance_coefficient": 0.0,
    "drag_area": 0.0,
}
"""What the file leaves out."""
HEIGHTS = {"front_roll_centre_height": 0.1, "rear_roll_centre_height": 0.15}
"""What the depths of the file come to."""
NUMBERS = {name: value for name, value in REFERENCE.items() if name != "tire"} | OPTIONAL | HEIGHTS
NAME, SYMBOL, VALUE, UNIT, ALLOWED, MEANING = range(6)


@pytest.fixture
def table(command):
    """The cells of the rows that `parameters` prints, the heading first."""

    def call(*words) -> list[list[str]]:
        result = command("parameters", *words)
        assert (result.status, result.err) == (0, "")
        lines = result.out.splitlines()
        assert all(line.startswith("| ") and line.endswith(" |") for line in lines)
        return [[cell.strip() for cell in line[1:-1].split("|")] for line in lines]

    return call


def values(cells: list[list[str]]) -> dict[str, float]:
    return {row[NAME].strip("`"): float(row[VALUE]) for row in cells[2:]}


def test_it_is_a_markdown_table_of_equally_wide_rows(table):
    heading, rule, *rows = table()
    assert heading == ["name", "symbol", "value", "unit", "allowed", "meaning"]
    assert set(rule) == {"---"}
    assert {len(row) for row in rows} == {len(heading)} == {len(rule)}


def test_it_has_every_parameter_of_the_vehicle_with_its_value(table):
    assert values(table()) == {name: float(value) for name, value in NUMBERS.items()}


def test_every_row_says_what_is_allowed_and_what_it_means(table):
    for row in table()[2:]:
        low, high = map(float, row[ALLOWED].split(" … "))
        assert low <= float(row[VALUE]) <= high
        assert row[MEANING]


def test_units_are_those_of_si(table):
    units = {row[NAME].strip("`"): row[UNIT] for row in table()[2:]}
    assert units["sprung_mass"] == units["rear_unsprung_mass"] == "kg"
    assert units["front_spring_stiffness"] == "N/m"
    assert units["rear_damping"] == "N s/m"
    assert units["wheel_inertia"] == "kg m^2"
    assert units["cg_height"] == units["front_roll_centre_depth"] == "m"
    assert units["steering_ratio"] == ""


def test_it_shows_the_vehicle_that_the_options_describe(table, folder):
    (folder / "reference.tir").write_text((PRESETS / "reference.tir").read_text())
    (folder / "mine.yaml").write_text(yaml.safe_dump(REFERENCE | {"front_track": 1.4}))
    shown = values(table("--vehicle", "mine.yaml", "--set", "sprung_mass=1234.5"))
    expected = NUMBERS | {"front_track": 1.4, "sprung_mass": 1234.5}
    assert shown == {name: float(value) for name, value in expected.items()}


def test_it_refuses_what_run_refuses(refused):
    refused(("parameters", "--set", "sprung_mass=-1"), "--set sprung_mass", "0.01")
    refused(("parameters", "--vehicle", "none.yaml"), "none.yaml")
