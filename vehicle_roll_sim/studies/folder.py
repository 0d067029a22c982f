"""A study from beginning to end, in a folder; and its report drawn again."""

import dataclasses
from collections.abc import Callable
from pathlib import Path

from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.studies.chunks import Compute, one_by_one
from vehicle_roll_sim.studies.figures import draw
from vehicle_roll_sim.studies.results import Results, results_of
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.store import CODE, IDENTITY, Store
from vehicle_roll_sim.studies.study import Study
from vehicle_roll_sim.studies.study_file import study_of
from vehicle_roll_sim.studies.summary import summary_of
from vehicle_roll_sim.studies.tables import PARQUET, write_tables

SUMMARY = "summary.md"
Progress = Callable[[int, bool], object]


@dataclasses.dataclass(frozen=True)
class Report:
    """The results of a study, the text of its summary, and all files that were written."""

    results: Results
    summary: str
    files: list[Path]


def run_study(
    study: Study,
    folder: Path,
    chosen: str = PARQUET,
    field: str = "folder",
    progress: Progress = lambda runs, kept: None,
    compute: Compute = one_by_one,
) -> Report:
    """Make the runs that are not in the folder yet, then write tables, summary and figures.

    chosen: format of the tables. field: names the folder in messages. progress: called after each
    chunk with its number of runs and whether they were in the folder. compute: computes chunks.
    Raises InputError.
    """
    store = Store(folder)
    with store.opened(study, field):
        results = results_of(study, store, progress, compute)
        files = write_tables(results, folder, chosen)
        summary, drawn = _reported(results, folder)
    return Report(results, summary, [*files, *drawn])


def show_study(folder: Path, field: str = "folder") -> Report:
    """Write summary and figures of the runs that are in a folder; nothing is computed.

    Raises InputError for a folder without a study.
    """
    store = Store(folder)
    identity = store.identity(field)
    source = Source(identity["study"], path=folder / IDENTITY)
    study = study_of(source, is_to_run=False, code=identity.get(CODE))
    results = results_of(study, store, compute=None)
    return Report(results, *_reported(results, folder))


def _reported(results: Results, folder: Path) -> tuple[str, list[Path]]:
    summary = summary_of(results)
    with replaced_file(folder / SUMMARY) as partial:
        partial.write_text(summary, encoding="utf-8")
    return summary, [folder / SUMMARY, *draw(results, folder)]
