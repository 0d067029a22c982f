"""The map of a study as the page gets it: points over two quantities, coloured by a third."""

import dataclasses
import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

MOST_POINTS = 2000
"""Of more runs, those that the page can open and as many at equal distances are points."""
DIGITS = 6
"""Significant digits of a number on the map."""


@dataclasses.dataclass(frozen=True)
class Quantity:
    """A quantity of all runs.

    label: with its unit. values: shape (runs,), nan for unknown; with `texts`, places in them.
    """

    label: str
    values: np.ndarray
    texts: tuple[str, ...] = ()


@dataclasses.dataclass(frozen=True)
class StudyMap:
    """All runs of a study as points.

    numbers: of the runs, shape (runs,), rising. opens: places of runs on the page by their number.
    axes: places of the quantities shown at first: to the right, up, and as colour.
    """

    numbers: np.ndarray
    quantities: Sequence[Quantity]
    opens: Mapping[int, int]
    axes: tuple[int, int, int]


def values_of_map(study: StudyMap) -> dict:
    """The map as JSON has it; a point that opens no run has None for the place."""
    kept = _kept(study)
    return {
        "points": [
            {"run": number, "place": study.opens.get(number)}
            for number in study.numbers[kept].tolist()
        ],
        "quantities": [
            {"label": each.label, "texts": each.texts, "values": _plain(each.values[kept])}
            for each in study.quantities
        ],
        "axes": study.axes,
        "count": len(study.numbers),
    }


def _kept(study: StudyMap) -> np.ndarray:
    """Places of the runs that become points."""
    count = len(study.numbers)
    if count <= MOST_POINTS:
        return np.arange(count)
    regular = np.linspace(0, count - 1, MOST_POINTS).round().astype(int)
    return np.union1d(regular, np.flatnonzero(np.isin(study.numbers, list(study.opens))))


def _plain(values: Iterable[float]) -> list[float | None]:
    """Numbers as JSON can have them."""
    return [float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None for value in values]
