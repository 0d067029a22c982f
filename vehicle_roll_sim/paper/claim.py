"""A claim of the source: what it says, what is measured, and whether that is what it says."""

import dataclasses
import math
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.paper.study import Response, Study

HOLDS, FAILS, NOT_CHECKED = "holds", "fails", "not checked"


@dataclasses.dataclass(frozen=True)
class Measured:
    """A number that a claim is judged by: it must lie between its limits.

    Without limits it is reported only. One that is nan fails: an event (in s) that never came, or
    what cannot be measured on these runs.
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


def driven_to_the_end(response: Response) -> Measured:
    """For a claim that a vehicle stays upright: a run that broke off shows nothing."""
    return Measured("runs broken off", 0.0 if response.is_complete else 1.0, "", below=1.0)


def largest(values: np.ndarray) -> float:
    """nan where there are none."""
    return float(values.max()) if len(values) else math.nan


def percent_more(value: float, other: float) -> float:
    """By how many percent `value` is above `other`."""
    return 100 * (value / other - 1)
