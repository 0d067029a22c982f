"""Logs that a library reads: Parquet by pyarrow, MATLAB files by scipy, MDF4 by asammdf."""

from pathlib import Path

import numpy as np

from vehicle_roll_sim.files.text_file import WANTED
from vehicle_roll_sim.input_errors import InputError, unknown_name
from vehicle_roll_sim.logs.map_file import LogMap
from vehicle_roll_sim.logs.quantities import TIME
from vehicle_roll_sim.logs.raw_log import RawLog, as_numbers, check_column

MATLAB_7_3 = "save it in MATLAB with -v7"
UNIT_KEY = b"unit"
"""Metadata of a Parquet column, as `study` writes it."""


def read_parquet_log(path: Path, log_map: LogMap) -> RawLog:
    """The mapped columns of a Parquet file; raises InputError."""
    try:
        from pyarrow import parquet  # optional, and a tenth of a second
    except ImportError:
        raise _missing(path, "pyarrow", "pip install 'vehicle_roll_sim[studies]'") from None
    _check_file(path)
    try:
        schema = parquet.read_schema(path)
        for column in log_map.columns.values():
            check_column(column.name, schema.names, column.field)
        wanted = list(dict.fromkeys(each.name for each in log_map.columns.values()))
        table = parquet.read_table(path, columns=wanted)
    except InputError:
        raise
    except Exception as error:  # of pyarrow, for a damaged file
        raise _refused(path, "a Parquet file", error) from None
    columns = {
        each.name: _of_parquet(table.column(each.name), each.field, each.name)
        for each in log_map.columns.values()
    }
    units = {
        name: (schema.field(name).metadata or {}).get(UNIT_KEY, b"").decode() for name in wanted
    }
    return RawLog(columns, units=units)


def _of_parquet(column, field: str, name: str) -> np.ndarray:
    """A column as floats, nan where it is null."""
    return as_numbers(column.to_numpy(), field, name)


def read_matlab_log(path: Path, log_map: LogMap) -> RawLog:
    """The mapped variables of a MATLAB file up to version 7; raises InputError.

    `imu.gyro_z` is the field of a structure.
    """
    from scipy.io import loadmat  # scipy takes 0.25 s to import

    _check_file(path)
    try:
        found = loadmat(path, squeeze_me=True, struct_as_record=False)
    except NotImplementedError:  # HDF5
        raise InputError(f"file {path}", "", MATLAB_7_3, "a MATLAB file of version 7.3") from None
    except Exception as error:  # of scipy, for a damaged file
        raise _refused(path, "a MATLAB file", error) from None
    variables = {name: each for name, each in found.items() if not name.startswith("__")}
    columns = {
        each.name: as_numbers(_in_structures(variables, each), each.field, each.name)
        for each in log_map.columns.values()
    }
    lengths = {len(each) for each in columns.values()}
    if len(lengths) > 1:
        counts = ", ".join(f"{name} {len(each)}" for name, each in columns.items())
        raise InputError(f"file {path}", "", "variables of one length", counts)
    return RawLog(columns)


def _in_structures(variables: dict, column):
    """The values of a variable, or of a field of a structure."""
    here, known = None, variables
    for part in column.name.split("."):
        if part not in known:
            raise unknown_name(part, known, f"{column.field}: column")
        here = known[part]
        known = {name: getattr(here, name) for name in getattr(here, "_fieldnames", ())}
    return here


def read_mdf_log(path: Path, log_map: LogMap) -> RawLog:
    """The mapped channels of an MDF file, each with its own times; raises InputError."""
    try:
        from asammdf import MDF  # optional, and a second
    except ImportError:
        raise _missing(path, "asammdf", "pip install 'vehicle_roll_sim[mdf]'") from None
    _check_file(path)
    raw = RawLog({})
    try:
        with MDF(path) as file:
            for quantity, column in log_map.columns.items():
                if quantity != TIME:  # each channel has its own
                    _keep_channel(raw, file, column)
    except InputError:
        raise
    except Exception as error:  # of asammdf, for a damaged file
        raise _refused(path, "an MDF file", error) from None
    return raw


def _keep_channel(raw: RawLog, file, column) -> None:
    """Add a channel to a log; raises InputError unless the file has it once."""
    places = file.channels_db.get(column.name, ())
    if not places:
        masters = {name for name, where in file.channels_db.items() if _is_time(file, where)}
        raise unknown_name(
            column.name, file.channels_db.keys() - masters, f"{column.field}: column"
        )
    if len(places) > 1:
        raise InputError(f"{column.field}: column", column.name, "a channel that the file has once")
    group, index = places[0]
    signal = file.get(column.name, group=group, index=index)
    raw.columns[column.name] = as_numbers(signal.samples, column.field, column.name)
    raw.times[column.name] = np.asarray(signal.timestamps, float)
    raw.units[column.name] = signal.unit


def _is_time(file, places) -> bool:
    """Whether all channels of a name are the times of their groups."""
    return all(file.masters_db.get(group) == index for group, index in places)


def _check_file(path: Path) -> None:
    """Raise InputError unless there is such a file."""
    try:
        with path.open("rb"):
            pass
    except OSError as error:
        allowed = WANTED.get(type(error), "give a file that can be read")
        raise InputError(f"file {path}", "", allowed, error.strerror) from None


def _missing(path: Path, library: str, install: str) -> InputError:
    return InputError("LOG", str(path), install, f"no Python package {library}")


def _refused(path: Path, wanted: str, error: Exception) -> InputError:
    problem = " ".join(str(error).split())[:200] or type(error).__name__
    return InputError(f"file {path}", "", wanted, problem)
