"""CSV logs of other programs: separators, decimal commas, missing values, and what is refused."""

import numpy as np
import pytest

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.csv_log import read_csv_log
from vehicle_roll_sim.logs.map_file import map_of

pandas = pytest.importorskip("pandas", reason="pandas writes the files")
FRAME = pandas.DataFrame(
    {"t": [0.0, 0.01, 0.02], "Gier [°/s]": [1.25, np.nan, -3.5], "x": [1, 2, 3]}
)
MAP = {"columns": {"time": {"column": "t"}, "yaw_rate": {"column": "Gier [°/s]"}}}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "log.csv"


@pytest.mark.parametrize(
    ("separator", "decimal"),
    [(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), ("|", ",")],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1"])
def test_what_pandas_writes_is_read(path, separator, decimal, encoding):
    FRAME.to_csv(path, sep=separator, decimal=decimal, index=False, encoding=encoding)
    raw = read_csv_log(path, map_of(MAP))
    assert list(raw.columns) == ["t", "Gier [°/s]"]
    np.testing.assert_array_equal(raw.columns["t"], FRAME["t"])
    np.testing.assert_array_equal(raw.columns["Gier [°/s]"], FRAME["Gier [°/s]"])
    assert bool(raw.notes) == ((separator, decimal) != (",", "."))


def test_quoted_decimal_commas_between_commas_are_read_if_the_map_names_them(path):
    FRAME.to_csv(path, decimal=",", index=False)
    raw = read_csv_log(path, map_of(MAP | {"separator": ",", "decimal": ","}))
    np.testing.assert_array_equal(raw.columns["t"], FRAME["t"])


def test_lines_above_the_names_and_a_line_of_units_are_passed_over(path):
    path.write_text("Logger 7\n\nt,Gier [°/s]\ns,deg/s\n0,1\n1,2\n\n", encoding="utf-8")
    raw = read_csv_log(path, map_of(MAP | {"header_line": 3, "first_line": 5}))
    np.testing.assert_array_equal(raw.columns["t"], [0.0, 1.0])


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("t,Gier [°/s]\n0,1\n1,x\n", "line 3: Gier [°/s]: 'x' is not allowed: a number"),
        ("t,Gier [°/s]\n0,1\n1\n", "line 3: 1 values: 2 values, separated by commas"),
        ("t,Gier\n0,1\n", "columns: yaw_rate: column: 'Gier [°/s]' is unknown: one of t, Gier"),
        ("t,Gier [°/s],t\n0,1,2\n", "columns: time: column: 't' is not allowed: a column that"),
        ("t,Gier [°/s]\n", "no rows"),
        ("", "no rows"),
        ("t" * 200_000 + ",r\n0,1\n", "line 1: field larger than field limit"),
        ("t;Gier [°/s]\n0,5;1.000,5\n0,6;2\n", "line 2: t: '0,5' is not allowed"),
        ("t,Gier [°/s]\n0,inf\n", "line 2: Gier [°/s]: 'inf' is not allowed"),
        ("t,Gier [°/s]\n0,1_0\n", "line 2: Gier [°/s]: '1_0' is not allowed"),
    ],
)
def test_what_cannot_be_read_is_named_with_its_line(path, text, problem):
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as raised:
        read_csv_log(path, map_of(MAP))
    assert problem in str(raised.value)
    assert "\n" not in str(raised.value)
