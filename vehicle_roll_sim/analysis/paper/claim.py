"""A claim of the source: what it says, what is measured, and whether that is what it says."""

import dataclasses
import math
from collections.abc import Callable

from vehicle_roll_sim.analysis.paper.study import Study

HOLDS, FAILS, NOT_CHECKED = "holds", "fails", "not checked"


@dataclasses.dataclass(frozen=True)
class Measured:
    """A number that a claim is judged by: it must lie between its limits.

    Without limits it is reported only. One that is nan, as of an event that never came, fails.
    """

    name: str
    value: float
    unit: str
    above: float = -math.inf
    below: float = math.inf

    @property
    def holds(self) -> bool:
        return not self.is_judged or self.above < self.value < self.below

    @property
    def is_judged(self) -> bool:
        return math.isfinite(self.above) or math.isfinite(self.below)

    @property
    def criterion(self) -> str:
        """The limits in words, without the unit; empty if there are none."""
        if math.isfinite(self.above) and math.isfinite(self.below):
            return f"{self.above:.3g} … {self.below:.3g}"
        if math.isfinite(self.above):
            return f"> {self.above:.3g}"
        return f"< {self.below:.3g}" if math.isfinite(self.below) else ""

    def __str__(self) -> str:
        value = "never" if math.isnan(self.value) else f"{self.value:.3g} {self.unit}"
        limits = f" ({self.criterion})" if self.is_judged else ""
        return f"{self.name}: {value}{limits}"


@dataclasses.dataclass(frozen=True)
class Claim:
    """number, place (section and figures) and text of a claim, and what is measured of it."""

    number: int
    place: str
    text: str
    measure: Callable[[Study], list[Measured]]
    needs_engine: bool = False

    def check(self, study: Study) -> "Finding":
        if self.needs_engine and not study.has_engine:
            return Finding(self, NOT_CHECKED, [])
        measured = self.measure(study)
        return Finding(self, HOLDS if all(m.holds for m in measured) else FAILS, measured)


@dataclasses.dataclass(frozen=True)
class Finding:
    """What came out of a claim: `verdict` is HOLDS, FAILS or NOT_CHECKED."""

    claim: Claim
    verdict: str
    measured: list[Measured]


def percent_more(value: float, other: float) -> float:
    """By how many percent `value` is above `other`."""
    return 100 * (value / other - 1)
