"""Thresholds by bracketing: at each point, the lowest value of a factor with an event."""

import dataclasses
import math
from collections.abc import Callable, Iterable, Sequence

import numpy as np

from vehicle_roll_sim.studies.study import Event, Search


@dataclasses.dataclass
class Bracket:
    """The search at one point.

    happened: by value of the factor, whether the event happened there; None in runs that failed,
    which count like those without the event.
    """

    point: dict
    happened: dict[float, bool | None]

    @property
    def threshold(self) -> float:
        """The lowest value at which the event happened; nan if it never did."""
        return min((value for value, event in self.happened.items() if event), default=math.nan)

    @property
    def below(self) -> float:
        """The highest value that was run below it; nan if there is none."""
        bound = math.inf if math.isnan(self.threshold) else self.threshold
        return max((value for value in self.happened if value < bound), default=math.nan)

    @property
    def failed(self) -> int:
        """Number of runs that failed."""
        return sum(event is None for event in self.happened.values())

    def next(self, resolution: float) -> float | None:
        """The value to run next, None if the interval is narrow enough."""
        width = self.threshold - self.below
        return self.below + width / 2.0 if width > resolution else None


def brackets(
    search: Search,
    event: Event,
    points: Sequence[dict],
    run: Callable[[list[dict]], Iterable[dict]],
) -> list[Bracket]:
    """Scan the range in equal steps, then bisect the first step in which the event appears.

    points: values of the other factors. run: makes runs at points with a value of the factor, all
    points together in each round. As with any bracketing, an event that occurs only inside one
    step, or that ceases at higher values, goes unnoticed.
    """
    found = [Bracket(point, {}) for point in points]
    first = np.linspace(search.lowest, search.highest, search.steps + 1)
    pending = [(each, float(value)) for each in found for value in first]
    while pending:
        rows = run([{**each.point, search.factor: value} for each, value in pending])
        for (each, value), row in zip(pending, rows, strict=True):
            each.happened[value] = event.happened(row)
        following = [(each, each.next(search.resolution)) for each in found]
        pending = [(each, value) for each, value in following if value is not None]
    return found
