"""Studies: many runs over varied values, kept in a folder that can be resumed."""

import dataclasses
import os
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.offline.tables import data_frame, known, path_of, structured
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.studies.cluster import computing
from vehicle_roll_sim.studies.folder import Report, run_study
from vehicle_roll_sim.studies.search import Bracket
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.study_file import study_of
from vehicle_roll_sim.studies.subset_simulation import Estimate
from vehicle_roll_sim.studies.tables import PARQUET, check_format, columns_of


@dataclasses.dataclass(frozen=True)
class StudyResult:
    """The result of a study; `result["peak_roll"]` is a column, an array of shape (runs,).

    columns: names of the columns: run, inputs, condition, reason and metrics. summary: the text of
    summary.md. thresholds: of a search, a Bracket per point; estimate: of a rare event; else None.
    files: what was written.
    """

    columns: tuple[str, ...]
    summary: str
    thresholds: list[Bracket] | None
    estimate: Estimate | None
    files: list[Path]
    values: dict[str, np.ndarray | list] = dataclasses.field(repr=False)

    def __getitem__(self, name: str) -> np.ndarray:
        known(name, self.columns)
        return np.array(self.values[name])

    def __len__(self) -> int:
        return len(self.values["run"])

    def to_numpy(self) -> np.ndarray:
        """The runs as a structured array, shape (runs,); unknown metrics are nan."""
        return structured(self.columns, [self[name] for name in self.columns])

    def to_pandas(self):
        """The runs as a DataFrame, units in `.attrs["units"]`; requires pandas."""
        return data_frame(self.to_numpy(), METRIC_UNITS)


def study(
    given: str | Path | Mapping,
    out: str | Path,
    *,
    format: str = PARQUET,
    progress: Callable[[int, bool], object] = lambda runs, kept: None,
    dask: str | None = None,
) -> StudyResult:
    """Run a study, or complete an interrupted one, like `vehicle_roll_sim study`.

    given: a study file, or a mapping of the same keys, in which `vehicle` may also be a Vehicle,
    `manoeuvre` a Manoeuvre and `controller` a ControlLaw. out: folder of the results. format: of
    the tables, parquet or csv. progress: called after each chunk with its number of runs, and
    whether they were in the folder already. dask: address of a Dask scheduler, whose workers
    compute the runs. Returns a StudyResult. Raises InputError, and ConnectionError if the scheduler
    is lost.
    """
    if isinstance(given, Mapping):
        source = Source(given)
    elif isinstance(given, str | os.PathLike):
        source = Source.of_file(path_of(given, "given"))
    else:
        raise InputError("given", given, "a study file, or a mapping of its keys")
    checked, folder = study_of(source), path_of(out, "out")
    check_format(format, "format")
    with computing(dask, "dask") as compute:
        return _result(run_study(checked, folder, format, "out", progress, compute))


def _result(report: Report) -> StudyResult:
    found = report.results
    kinds = columns_of(found)
    values = {
        name: np.empty(len(found.runs)) if kind is float else [] for name, kind in kinds.items()
    }
    for i, row in enumerate(found.runs):
        for name, column in values.items():
            if isinstance(column, list):
                column.append(row[name])
            else:
                column[i] = np.nan if row[name] is None else row[name]
    return StudyResult(
        tuple(kinds), report.summary, found.brackets, found.estimate, report.files, values
    )
