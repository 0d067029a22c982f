"""Parquet, MATLAB and MDF files that other libraries write, and what is refused of them."""

import sys

import numpy as np
import pytest
from scipy.io import savemat

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.library_logs import read_matlab_log, read_mdf_log, read_parquet_log
from vehicle_roll_sim.logs.map_file import map_of

TIME = np.arange(0.0, 1.0, 0.01)
ROLL = 0.1 * np.sin(5.0 * TIME)
MAP = {"columns": {"time": {"column": "t"}, "roll": {"column": "phi"}}}


def mapped(**names: str):
    """A map of the quantities to these columns."""
    return map_of({"columns": {name: {"column": column} for name, column in names.items()}})


def test_what_pandas_writes_to_parquet_is_read(tmp_path):
    pandas = pytest.importorskip("pandas", reason="pandas writes the file")
    pytest.importorskip("pyarrow", reason="Parquet files need pyarrow")
    roll = np.where(TIME == 0.5, np.nan, ROLL)
    frame = pandas.DataFrame({"t": TIME, "phi": roll, "n": np.arange(len(TIME)), "text": "a"})
    frame.to_parquet(tmp_path / "log.parquet")
    raw = read_parquet_log(tmp_path / "log.parquet", mapped(time="t", roll="phi", speed="n"))
    np.testing.assert_array_equal(raw.columns["t"], TIME)
    np.testing.assert_array_equal(raw.columns["phi"], roll)
    np.testing.assert_array_equal(raw.columns["n"], np.arange(len(TIME)))
    with pytest.raises(InputError, match="columns: roll: column: 'text' is not allowed: a column"):
        read_parquet_log(tmp_path / "log.parquet", mapped(roll="text"))
    with pytest.raises(
        InputError, match="columns: roll: column: 'ph' is unknown: did you mean phi"
    ):
        read_parquet_log(tmp_path / "log.parquet", mapped(roll="ph"))


def test_variables_and_structures_of_a_matlab_file_are_read(tmp_path):
    path = tmp_path / "log.mat"
    savemat(path, {"t": TIME[:, np.newaxis], "imu": {"roll": ROLL, "raw": {"n": TIME}}, "x": "a"})
    raw = read_matlab_log(path, mapped(time="t", roll="imu.roll", speed="imu.raw.n"))
    np.testing.assert_array_equal(raw.columns["t"], TIME)
    np.testing.assert_array_equal(raw.columns["imu.roll"], ROLL)
    np.testing.assert_array_equal(raw.columns["imu.raw.n"], TIME)


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("imu.rol", "columns: roll: column: 'rol' is unknown: did you mean roll"),
        ("u", "columns: roll: column: 'u' is unknown: one of t, short, imu, x"),
        ("x", "columns: roll: column: 'x' is not allowed: a column of numbers"),
        ("imu", "columns: roll: column: 'imu' is not allowed: a column of numbers"),
        ("short", "variables of one length"),
    ],
)
def test_what_a_matlab_file_does_not_have_is_named(tmp_path, name, problem):
    path = tmp_path / "log.mat"
    savemat(path, {"t": TIME, "short": TIME[:5], "imu": {"roll": ROLL}, "x": "a"})
    with pytest.raises(InputError, match=problem):
        read_matlab_log(path, mapped(time="t", roll=name))


def test_channels_of_an_mdf_file_are_read_with_their_own_times_and_units(tmp_path):
    asammdf = pytest.importorskip("asammdf", reason="MDF files need asammdf")
    path = tmp_path / "log.mf4"
    slow = TIME[::4]
    with asammdf.MDF(version="4.10") as file:
        fast = asammdf.Signal(ROLL, TIME, name="phi", unit="rad")
        speed = asammdf.Signal(np.full(len(slow), 72), slow, name="v", unit="km/h")
        for signal in (fast, speed):
            file.append([signal])
        file.append([asammdf.Signal(ROLL, TIME, name="twice")])
        file.append([asammdf.Signal(ROLL, TIME, name="twice")])
        file.save(path)
    raw = read_mdf_log(path, mapped(roll="phi", speed="v"))
    np.testing.assert_array_equal(raw.columns["phi"], ROLL)
    np.testing.assert_allclose(raw.times["phi"], TIME, atol=1e-12)
    np.testing.assert_array_equal(raw.columns["v"], 72.0)
    np.testing.assert_allclose(raw.times["v"], slow, atol=1e-12)
    assert raw.units == {"phi": "rad", "v": "km/h"}
    with pytest.raises(InputError, match="columns: roll: column: 'fi' is unknown: one of"):
        read_mdf_log(path, mapped(roll="fi"))
    with pytest.raises(InputError, match="column: 'twice' is not allowed: a channel that the file"):
        read_mdf_log(path, mapped(roll="twice"))


READERS = [
    (read_parquet_log, "pyarrow", "a Parquet file"),
    (read_matlab_log, "scipy", "a MATLAB file"),
    (read_mdf_log, "asammdf", "an MDF file"),
]


@pytest.mark.parametrize(("read", "library", "kind"), READERS)
@pytest.mark.parametrize("content", [b"", b"no such file at all" * 20])
def test_a_damaged_file_is_refused_in_one_line(tmp_path, read, library, kind, content):
    pytest.importorskip(library, reason=f"{kind} needs {library}")
    path = tmp_path / "log.bin"
    path.write_bytes(content)
    with pytest.raises(InputError, match=kind) as raised:
        read(path, map_of(MAP))
    assert "\n" not in str(raised.value)
    with pytest.raises(InputError, match="No such file or directory: give the name of an existing"):
        read(tmp_path / "none", map_of(MAP))


@pytest.mark.parametrize(
    ("read", "modules"),
    [(read_parquet_log, ("pyarrow", "pyarrow.parquet")), (read_mdf_log, ("asammdf",))],
)
def test_without_the_library_it_is_named(tmp_path, monkeypatch, read, modules):
    for module in modules:
        monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(InputError, match=f"no Python package {modules[0]}: pip install 'vehicle"):
        read(tmp_path / "log", map_of(MAP))
