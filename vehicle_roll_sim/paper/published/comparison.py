"""Published numbers beside the ones computed here."""

import dataclasses
from collections.abc import Callable, Sequence

from vehicle_roll_sim.paper.published.reruns import RERUNS
from vehicle_roll_sim.paper.published.source import Number, numbers

AGREES, DIFFERS, NOT_JUDGED = "agrees", "differs", "not judged"


@dataclasses.dataclass(frozen=True)
class Compared:
    """A published number and what was computed for it, in the same unit."""

    number: Number
    computed: float

    @property
    def difference(self) -> float:
        """Computed less published; nan if nothing could be computed."""
        return self.computed - self.number.published

    @property
    def verdict(self) -> str:
        """AGREES, DIFFERS (as nan does), or NOT_JUDGED without a tolerance."""
        if self.number.tolerance is None:
            return NOT_JUDGED
        return AGREES if abs(self.difference) <= self.number.tolerance else DIFFERS


def compare(
    published: Sequence[Number] | None = None, done: Callable[[], None] = lambda: None
) -> list[Compared]:
    """Compute every published number; by default all. done: called after each."""
    found = []
    for number in numbers() if published is None else published:
        found.append(Compared(number, RERUNS[number.rerun](number.vehicle, **number.conditions)))
        done()
    return found
