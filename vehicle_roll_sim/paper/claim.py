"""A claim of the paper, the measurements that test it, and the verdict."""

import dataclasses
import math
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.paper.study import Response, Study

HOLDS, FAILS, NOT_CHECKED = "holds", "fails", "not checked"


@dataclasses.dataclass(frozen=True)
class Measured:
    """A measured value that must lie between its limits for the claim to hold.

    Without limits it is only reported. With limits, nan fails: an event (s) that never occurred, or
    a quantity that cannot be measured on these runs.
    """

    name: str
    value: float
    unit: str
    above: float = -math.inf
    below: float = math.inf

    @property
    def holds(self) -> bool:
        if not self.is_judged:
            return True
        is_above = self.value > self.above or math.isinf(self.above)
        is_below = self.value < self.below or math.isinf(self.below)
        return is_above and is_below and not math.isnan(self.value)

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
        value = f"{self.value:.3g} {self.unit}".rstrip()
        if math.isnan(self.value) and self.unit == "s":
            value = "never"
        limits = f" ({self.criterion})" if self.is_judged else ""
        return f"{self.name}: {value}{limits}"


@dataclasses.dataclass(frozen=True)
class Claim:
    """A claim: number, place (section and figures), text, and the function that measures it."""

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
    """The result for a claim; verdict: HOLDS, FAILS or NOT_CHECKED."""

    claim: Claim
    verdict: str
    measured: list[Measured]


def driven_to_the_end(response: Response) -> Measured:
    """For claims that a vehicle stays upright, which a run that stopped early cannot show."""
    return Measured("runs stopped early", 0.0 if response.is_complete else 1.0, "", below=1.0)


def largest(values: np.ndarray) -> float:
    """The largest value; nan if there is none."""
    return float(values.max()) if len(values) else math.nan


def percent_more(value: float, other: float) -> float:
    """By how many percent `value` exceeds `other`."""
    return 100 * (value / other - 1)
