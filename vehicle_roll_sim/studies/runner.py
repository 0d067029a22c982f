"""Runs of a study at given points: from the folder if they are done, else computed and kept."""

import dataclasses
from collections.abc import Callable, Iterator, Sequence

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.studies.chunks import RESULTS, Compute, one_by_one
from vehicle_roll_sim.studies.store import Store
from vehicle_roll_sim.studies.study import Study


class NotDoneError(Exception):
    """A run is needed that is not in the folder."""


@dataclasses.dataclass(frozen=True)
class KeptRuns:
    """Runs in the folder of a study, read chunk by chunk: they are never in memory together.

    columns: names of their values. chunks: number of runs by the number of the chunk. Iterating
    yields mappings by name of the column.
    """

    store: Store
    columns: tuple[str, ...]
    chunks: dict[int, int]

    def __len__(self) -> int:
        return sum(self.chunks.values())

    def __iter__(self) -> Iterator[dict]:
        for row in self.rows():
            yield dict(zip(self.columns, row, strict=True))

    def rows(self) -> Iterator[list]:
        """The values of each run."""
        for number in self.chunks:
            yield from self.store.chunk(number)


class Runner:
    """Makes the runs of a study in chunks; a chunk always has the same number and points.

    chunks: number of runs of all chunks so far, by their number. progress: called with the number
    of runs after each chunk, and whether they were in the folder. compute: computes chunks; None:
    raise NotDoneError instead.
    """

    def __init__(
        self,
        study: Study,
        store: Store,
        progress: Callable[[int, bool], object] = lambda runs, kept: None,
        compute: Compute | None = one_by_one,
    ):
        self.study, self.store, self.progress, self.compute = study, store, progress, compute
        self.chunks: dict[int, int] = {}
        self._begun = 0

    @property
    def runs(self) -> KeptRuns:
        """All runs so far."""
        columns = ("run", *self.study.inputs, *RESULTS)
        return KeptRuns(self.store, columns, dict(sorted(self.chunks.items())))

    def __call__(self, points: Sequence[dict]) -> KeptRuns:
        """Make the runs at these points, values by name of the input."""
        size, first, begun = self.study.settings.chunk, len(self.chunks), self._begun
        numbers = range(first, first + -(-len(points) // size))

        def part(number: int) -> Sequence[dict]:
            start = (number - first) * size
            return points[start : start + size]

        def inputs(number: int) -> list[list]:
            start = begun + (number - first) * size
            return [[start + i, *point.values()] for i, point in enumerate(part(number))]

        missing = [number for number in numbers if not self._is_kept(number, inputs)]
        if missing and self.compute is None:
            raise NotDoneError
        chunks = ((number, part(number)) for number in missing)
        for number, results in self.compute(self.study, chunks) if missing else ():
            rows = [[*run, *found] for run, found in zip(inputs(number), results, strict=True)]
            self.store.keep(number, rows)
            self._count(number, rows, is_kept=False)
        self._begun += len(points)
        own = {number: self.chunks[number] for number in numbers}
        return dataclasses.replace(self.runs, chunks=own)

    def _is_kept(self, number: int, inputs: Callable[[int], list[list]]) -> bool:
        """Whether a chunk is in the folder; raises InputError if it has other runs."""
        rows = self.store.chunk(number)
        if rows is None:
            return False
        expected, metrics = inputs(number), len(RESULTS) - 2
        width = 1 + len(self.study.inputs)
        is_intact = isinstance(rows, list) and all(
            isinstance(row, list)
            and len(row) == width + len(RESULTS)
            and all(isinstance(text, str) for text in row[width:-metrics])
            and all(isinstance(value, float | int | None) for value in row[-metrics:])
            for row in rows
        )
        if not is_intact or [row[:width] for row in rows] != expected:
            allowed = "the file as it was written; if you delete it, its runs are computed again"
            path = self.store.path(number)
            raise InputError(f"file {path}", "", allowed, "it has other runs")
        self._count(number, rows, is_kept=True)
        return True

    def _count(self, number: int, rows: list, is_kept: bool) -> None:
        self.chunks[number] = len(rows)
        self.progress(len(rows), is_kept)
