"""`parameters`: a Markdown table of every parameter of a vehicle."""

import pytest
import yaml

from vehicle_roll_sim.vehicle.vehicle_file import PRESETS

REFERENCE = yaml.safe_load((PRESETS / "reference.yaml").read_text())
OPTIONAL = {
    "minimum_relaxation_length": 0.1,
    "rolling_resistance_coefficient": 0.0,
    "drag_area": 0.0,
    "front_camber": 0.0,
    "rear_camber": 0.0,
}
"""What the file leaves out."""
HEIGHTS = {"front_roll_centre_height": 0.1, "rear_roll_centre_height": 0.15}
"""What the depths of the file come to."""
RADII = {"front_tire_radius": 0.285, "rear_tire_radius": 0.285}
"""What the one radius comes to."""
NOT_NUMBERS = ("tire", "tire_moments", "contact_patch_shift")
NUMBERS = {n: v for n, v in REFERENCE.items() if n not in NOT_NUMBERS} | OPTIONAL | HEIGHTS | RADII
FROM_TIRE = ("front_tire_lateral_stiffness", "rear_tire_lateral_stiffness")
PRESSURES = ("tire_pressure", "front_tire_pressure", "rear_tire_pressure")
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
    """The values but for those that a vehicle need not have, and what its tires give."""
    shown = {row[NAME].strip("`"): row[VALUE] for row in cells[2:]}
    return {n: float(v) for n, v in shown.items() if v != "–" and n not in FROM_TIRE}


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
        assert row[VALUE] == "–" or low <= float(row[VALUE]) <= high
        assert row[MEANING]


def test_what_the_tire_file_gives_says_so_and_what_nobody_gives_has_no_value(table, folder):
    rows = {row[NAME].strip("`"): row for row in table()[2:]}
    for name in FROM_TIRE:
        assert float(rows[name][VALUE]) == pytest.approx(92.5e3, rel=0.01)
        assert "(here: cornering stiffness over relaxation length" in rows[name][MEANING]
    assert {rows[name][VALUE] for name in PRESSURES} == {"–"}
    bare = {n: v for n, v in REFERENCE.items() if n not in ("tire_radius", "rear_tire_stiffness")}
    (folder / "bare.yaml").write_text(yaml.safe_dump(bare | {"tire": "reference"}))
    rows = {row[NAME].strip("`"): row for row in table("--vehicle", "bare.yaml")[2:]}
    for name, key in (
        ("front_tire_radius", "UNLOADED_RADIUS"),
        ("rear_tire_stiffness", "VERTICAL"),
    ):
        assert float(rows[name][VALUE]) == NUMBERS[name]
        assert f"(here: {key}" in rows[name][MEANING]


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


def test_the_rear_steering_does_not_take_the_actuator_of_the_front_one(table):
    name = "steering_actuator_dead_time"
    shown = values(table("--set", f"{name}=0.02"))
    assert shown == {**{n: float(v) for n, v in NUMBERS.items()}, name: 0.02}


def test_it_refuses_what_run_refuses(refused):
    refused(("parameters", "--set", "sprung_mass=-1"), "--set sprung_mass", "0.01")
    refused(("parameters", "--vehicle", "none.yaml"), "none.yaml")


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("payload", "payload is a key of vehicle files only: write it into a vehicle file"),
        ("longitudinal", "write it into a vehicle file (--vehicle)"),
        ("model", "model is no number: give --model instead"),
        ("contact_patch_shift", "give --contact-patch-shift instead"),
        ("rear_tire", "give --rear-tire instead"),
        ("front_spring_force", "a table is no number: write it into a vehicle file"),
    ],
)
def test_what_is_no_number_is_refused_with_the_place_where_it_belongs(refused, name, told):
    refused(("parameters", "--set", f"{name}=1"), told)
