"""The runs and thresholds of a study as Parquet or CSV files."""

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.files.table_file import write_rows
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.studies.chunks import CONDITION, REASON
from vehicle_roll_sim.studies.results import Results

PARQUET, CSV = FORMATS = ("parquet", "csv")
VERSION = "2.6"
"""Of the Parquet format."""
GROUP = 20_000
"""Rows of a Parquet file that are in memory, and in the file, together."""


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
    tables = {"runs": (columns_of(results), results.runs.rows())}
    if results.brackets is not None:
        tables["thresholds"] = _thresholds(results)
    files = []
    for name, (kinds, rows) in tables.items():
        files.append(folder / f"{name}.{chosen}")
        if chosen == CSV:
            write_rows(files[-1], list(kinds), rows)
        else:
            _write_parquet(files[-1], kinds, rows)
    return files


def columns_of(results: Results) -> dict[str, type]:
    """The columns of the runs by name, and what their values are."""
    inputs = results.study.kinds
    texts = dict.fromkeys((CONDITION, REASON), str)
    return {"run": int, **inputs, **texts, **dict.fromkeys(METRIC_UNITS, float)}


def _thresholds(results: Results) -> tuple[dict[str, type], Iterator[tuple]]:
    """Columns and rows: the factors, the threshold, the value below it and what it took."""
    study = results.study
    found = {"threshold": float, "below": float, "runs": int, "failed_runs": int}
    rows = (
        (*each.point.values(), each.threshold, each.below, len(each.happened), each.failed)
        for each in results.brackets
    )
    return {name: study.kinds[name] for name in study.factors} | found, rows


def _write_parquet(path: Path, kinds: dict[str, type], rows: Iterable[Sequence]) -> None:
    import pyarrow
    from pyarrow import parquet

    types = {
        int: pyarrow.int64(),
        float: pyarrow.float64(),
        str: pyarrow.string(),
        bool: pyarrow.bool_(),
    }
    schema = pyarrow.schema(
        pyarrow.field(name, types[kind], metadata={"unit": METRIC_UNITS.get(name, "")})
        for name, kind in kinds.items()
    )
    rows = iter(rows)
    with (
        replaced_file(path) as partial,
        parquet.ParquetWriter(partial, schema, version=VERSION, compression="snappy") as file,
    ):
        while group := list(itertools.islice(rows, GROUP)):
            columns = zip(*group, strict=True)
            arrays = [pyarrow.array(v, each.type) for v, each in zip(columns, schema, strict=True)]
            file.write_table(pyarrow.Table.from_arrays(arrays, schema=schema))


def cell(value: float) -> str:
    """A number with four significant digits; a dash for never."""
    return "–" if math.isnan(value) else f"{value:.4g}"
