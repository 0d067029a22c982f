"""The runs and thresholds of a study as Parquet or CSV files."""

import math
from pathlib import Path

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.files.table_file import write_rows
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.studies.results import Results

PARQUET, CSV = FORMATS = ("parquet", "csv")
VERSION = "2.6"
"""Of the Parquet format."""


def check_format(chosen: str, field: str) -> None:
    """Raise InputError naming `field` unless files of this format can be written."""
    if chosen not in FORMATS:
        raise InputError(field, chosen, " or ".join(FORMATS))
    if chosen == PARQUET:
        try:
            import pyarrow.parquet  # noqa: F401  optional, and a tenth of a second
        except ImportError:
            allowed = f"pip install pyarrow, or {CSV} instead of {PARQUET}"
            raise InputError(field, "", allowed, "no Python package pyarrow") from None


def write_tables(results: Results, folder: Path, chosen: str) -> list[Path]:
    """Write a row for each run and, of a search, for each threshold; returns the files.

    The same rows give the same bytes. In CSV files metrics of runs that failed are empty.
    """
    tables = {"runs": (results.columns, [tuple(row.values()) for row in results.rows])}
    if results.brackets is not None:
        tables["thresholds"] = _thresholds(results)
    files = []
    for name, (columns, rows) in tables.items():
        files.append(folder / f"{name}.{chosen}")
        if chosen == CSV:
            write_rows(files[-1], columns, rows)
        else:
            _write_parquet(files[-1], columns, rows)
    return files


def _thresholds(results: Results) -> tuple[tuple, list[tuple]]:
    """Columns and rows: the factors, the threshold, the value below it and what it took."""
    columns = (*results.study.factors, "threshold", "below", "runs", "failed_runs")
    rows = [
        (*each.point.values(), each.threshold, each.below, len(each.happened), each.failed)
        for each in results.brackets
    ]
    return columns, rows


def _write_parquet(path: Path, columns: tuple, rows: list[tuple]) -> None:
    import pyarrow
    from pyarrow import parquet

    arrays = {
        name: pyarrow.array([row[i] for row in rows], _type_of(pyarrow, [row[i] for row in rows]))
        for i, name in enumerate(columns)
    }
    fields = [
        pyarrow.field(name, array.type, metadata={"unit": METRIC_UNITS.get(name, "")})
        for name, array in arrays.items()
    ]
    table = pyarrow.Table.from_arrays(list(arrays.values()), schema=pyarrow.schema(fields))
    with replaced_file(path) as partial:
        parquet.write_table(table, partial, version=VERSION, compression="snappy")


def _type_of(pyarrow, values: list):
    """The type of a column: text, whole numbers, true and false, or numbers."""
    present = [value for value in values if value is not None]
    for kind, of_column in (
        (bool, pyarrow.bool_()),
        (int, pyarrow.int64()),
        (str, pyarrow.string()),
    ):
        if present and all(type(value) is kind for value in present):
            return of_column
    return pyarrow.float64()


def cell(value: float) -> str:
    """A number with four significant digits; a dash for never."""
    return "–" if math.isnan(value) else f"{value:.4g}"
