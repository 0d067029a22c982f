"""Reading a log in any of its formats."""

from pathlib import Path

from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.csv_log import read_csv_log
from vehicle_roll_sim.logs.library_logs import read_matlab_log, read_mdf_log, read_parquet_log
from vehicle_roll_sim.logs.map_file import LogMap
from vehicle_roll_sim.logs.quantities import TIME
from vehicle_roll_sim.logs.raw_log import RawLog

READERS = {
    **dict.fromkeys((".csv", ".txt", ".tsv", ".dat"), read_csv_log),
    ".parquet": read_parquet_log,
    ".mat": read_matlab_log,
    **dict.fromkeys((".mf4", ".mdf"), read_mdf_log),
}
"""The reader of each suffix."""
FIELD = "LOG"


def read_log(path: Path, log_map: LogMap) -> RawLog:
    """The mapped columns of a log; raises InputError for a file of another format."""
    if path.is_dir():
        return _bag(path, log_map)
    suffix = path.suffix.lower()
    if suffix not in READERS:
        allowed = "a bag, or a file ending in " + ", ".join(READERS)
        raise InputError(FIELD, str(path), allowed)
    return READERS[suffix](path, log_map)


def _bag(path: Path, log_map: LogMap) -> RawLog:
    """The mapped fields of a bag's messages, each topic with its own times."""
    need_library(FIELD)
    from vehicle_roll_sim.bags.topic_columns import read_topics  # its library is optional

    fields = {each.name: each.field for name, each in log_map.columns.items() if name != TIME}
    found, unstamped = read_topics(path, fields)
    times, columns = ({name: each[k] for name, each in found.items()} for k in range(2))
    notes = [f"recorder's times: {', '.join(unstamped)}"] if unstamped else []
    return RawLog(columns, times, notes=notes)
