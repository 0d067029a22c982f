"""Warnings of a controller, judged: how early they come, and which are false or missed."""

import dataclasses
import math
from collections.abc import Iterable

import numpy as np

from vehicle_roll_sim.manoeuvres.criteria import two_wheel_lift
from vehicle_roll_sim.scoring.driven import Outcome


@dataclasses.dataclass(frozen=True)
class Alarm:
    """The warning in one run.

    first: time of the first warning (s), nan if there is none. danger: time of the two-wheel lift
    or, if there is none, of the rollover or stop (s), in the run itself, else without the
    controller; nan if there is none in either. averted: whether it occurs only without the
    controller.
    """

    first: float
    danger: float
    averted: bool

    @property
    def is_false(self) -> bool:
        """A warning in a run that is in no danger, even without the controller."""
        return not math.isnan(self.first) and math.isnan(self.danger)

    @property
    def is_missed(self) -> bool:
        """No warning before a danger that the controller did not avert."""
        return not (math.isnan(self.danger) or self.averted or self.first < self.danger)

    @property
    def lead(self) -> float:
        """Time (s) from the first warning to the danger; nan without either, or if it is late."""
        return self.danger - self.first if self.first < self.danger else math.nan


def alarm_of(alone: Outcome, controlled: Outcome) -> Alarm:
    """The warning in a run with a controller; `alone`: the same run without it."""
    warned = np.flatnonzero(controlled.warned)
    first = float(controlled.history["time"][warned[0]]) if len(warned) else math.nan
    own, other = _danger(controlled), _danger(alone)
    averted = math.isnan(own) and not math.isnan(other)
    return Alarm(first, other if averted else own, averted)


def _danger(outcome: Outcome) -> float:
    lifted = two_wheel_lift(outcome.history)
    if math.isnan(lifted) and not outcome.is_complete:
        return float(outcome.history["time"][-1])
    return lifted


@dataclasses.dataclass(frozen=True)
class Alarms:
    """The warnings of all runs. leads: lead times (s), in rising order."""

    runs: int
    dangers: int
    false: int
    missed: int
    leads: tuple[float, ...]

    @classmethod
    def of(cls, alarms: Iterable[Alarm]) -> "Alarms":
        found = list(alarms)
        leads = sorted(each.lead for each in found if not math.isnan(each.lead))
        return cls(
            len(found),
            sum(not math.isnan(each.danger) for each in found),
            sum(each.is_false for each in found),
            sum(each.is_missed for each in found),
            tuple(leads),
        )
