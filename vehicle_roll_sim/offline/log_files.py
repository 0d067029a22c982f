"""Reading a log in any of its formats."""

from pathlib import Path

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.csv_log import read_csv_log
from vehicle_roll_sim.logs.map_file import LogMap
from vehicle_roll_sim.logs.raw_log import RawLog

READERS = {
    **dict.fromkeys((".csv", ".txt", ".tsv", ".dat"), read_csv_log),
}
"""The reader of each suffix."""
FIELD = "LOG"


def read_log(path: Path, log_map: LogMap) -> RawLog:
    """The mapped columns of a log; raises InputError for a file of another format."""
    suffix = path.suffix.lower()
    if suffix not in READERS:
        allowed = "a file ending in " + ", ".join(READERS)
        raise InputError(FIELD, str(path), allowed)
    return READERS[suffix](path, log_map)
