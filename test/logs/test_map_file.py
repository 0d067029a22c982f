"""Map files: what they may say, and one line for what they may not."""

import pytest

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.map_file import map_of

TEXT = """\
axes: sae
columns:
  time: {column: t, unit: s}
  roll: {column: phi, unit: deg}
  yaw_rate: {column: r, unit: deg/s, sign: -1}
  lateral_acceleration: {column: ay, unit: g, place: [1, 0.5, -0.2], frame: level}
"""


def test_a_file_and_a_mapping_say_the_same(tmp_path):
    (tmp_path / "map.yaml").write_text(TEXT)
    found = map_of(tmp_path / "map.yaml")
    assert found.columns["lateral_acceleration"].place == (1.0, 0.5, -0.2)
    assert found.columns["lateral_acceleration"].frame == "level"
    assert (found.separator, found.decimal, found.header_line, found.first_line) == (
        None,
        None,
        1,
        2,
    )
    mapping = {"axes": "sae", "columns": {"roll": {"column": "phi", "unit": "deg"}}}
    assert map_of(mapping).columns["roll"].unit == "deg"


def test_axes_with_z_down_flip_what_is_about_y_and_z_and_not_the_roll(tmp_path):
    (tmp_path / "map.yaml").write_text(TEXT)
    found = map_of(tmp_path / "map.yaml")
    assert found.sign("roll") == 1.0
    assert found.sign("lateral_acceleration") == -1.0
    assert found.sign("yaw_rate") == 1.0  # and once more by its own sign


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ("sae", "din", "line 1: axes: 'din' is not allowed: one of 'iso', 'sae'"),
        ("columns:", "colums:", "line 2: colums: 'colums' is unknown: did you mean columns?"),
        ("roll:", "rol:", "line 4: columns: rol: 'rol' is unknown: did you mean roll?"),
        ("column: phi", "colum: phi", "roll: colum: 'colum' is unknown: did you mean column?"),
        ("column: phi", "column: 3", "columns: roll: column: 3 is not allowed"),
        ("column: phi, unit: deg", "unit: deg", "columns: roll: column: missing"),
        ("unit: deg}", "unit: 4}", "columns: roll: unit: 4 is not allowed"),
        ("sign: -1", "sign: 2", "columns: yaw_rate: sign: 2 is not allowed: 1 or -1"),
        ("sign: -1", "place: [0, 0, 0]", "yaw_rate: place: [0, 0, 0] is not allowed: only"),
        ("sign: -1", "frame: body", "yaw_rate: frame: 'body' is not allowed: only"),
        ("-0.2]", "-60]", "place: [1, 0.5, -60] is not allowed: [forward, left, up]"),
        ("[1, 0.5, -0.2]", "1", "place: 1 is not allowed: [forward, left, up]"),
        ("frame: level", "frame: road", "frame: 'road' is not allowed: one of 'body', 'level'"),
        ("axes: sae", "header_line: 0", "line 1: header_line: 0 is not allowed: a whole number"),
        ("axes: sae", "first_line: 1", "first_line: 1 is not allowed: a whole number from 2"),
        ("axes: sae", "decimal: ;", "line 1: decimal: ';' is not allowed: one of '.', ','"),
        ("{column: phi, unit: deg}", "phi", "columns: roll: 'phi' is not allowed: {column: NAME"),
    ],
)
def test_what_it_may_not_say_is_named_with_its_line(tmp_path, old, new, problem):
    assert old in TEXT
    (tmp_path / "map.yaml").write_text(TEXT.replace(old, new))
    with pytest.raises(InputError) as raised:
        map_of(tmp_path / "map.yaml")
    assert problem in str(raised.value)
    assert str(raised.value).startswith(f"{tmp_path / 'map.yaml'}: ")


def test_a_map_without_columns_is_refused():
    with pytest.raises(InputError, match="map: columns: missing"):
        map_of({"axes": "iso"})
