"""Profile likelihood of one value: how much worse the logs fit where it is held elsewhere."""

import dataclasses
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.identification.estimate import Estimate, fitted
from vehicle_roll_sim.identification.problem import Prior
from vehicle_roll_sim.input_errors import unknown_name

POINTS, REACH = 9, 3.0
"""Number of values, odd, and how far from the estimate the outer ones are (standard errors)."""
HELD = 1e-3
"""Standard errors: of the prior that holds the value."""
LIMIT = 3.841
"""Deviance at the ends of an interval of 95 % (chi-squared, one degree of freedom)."""


@dataclasses.dataclass(frozen=True)
class Profile:
    """Of one value, in its unit: values, increasing, and their deviances, (n,) each.

    A deviance is the increase of the sum of squares over the spreads, in proportion to the variance
    of the value with white residuals over that with the residuals as they are (Chandler and Bate,
    2007). error: standard error, with which a parabola would rise to the limit.
    """

    name: str
    unit: str
    estimate: float
    error: float
    values: np.ndarray
    deviances: np.ndarray

    @property
    def interval(self) -> tuple[float, float]:
        """Interval of 95 %; nan where the profile does not reach the limit."""
        roots = np.sign(self.values - self.estimate) * np.sqrt(np.maximum(self.deviances, 0.0))
        ends = np.interp((-(LIMIT**0.5), LIMIT**0.5), roots, self.values, left=np.nan, right=np.nan)
        return float(ends[0]), float(ends[1])


def profile(
    estimate: Estimate, name: str, progress: Callable[[int], None] = lambda runs: None
) -> Profile:
    """The profile of an identified value. Raises InputError for another name."""
    names = [each.name for each in estimate.free]
    if name not in names:
        raise unknown_name(name, names, "profile")
    problem, place = estimate.problem, names.index(name)
    free = problem.free[place]
    error = float(estimate.uncertainty.errors[place])
    white = float(estimate.uncertainty.naive[place, place])
    along = estimate.uncertainty.naive[:, place] / white
    offsets = np.linspace(-REACH, REACH, POINTS) * error
    lower, upper = (bound[place] for bound in problem.bounds)
    offsets = np.clip(offsets, lower - estimate.scaled[place], upper - estimate.scaled[place])
    offsets = np.unique(offsets)
    given, deviances = problem.priors, []
    for offset in offsets:
        start = estimate.scaled + along * offset
        held = Prior((estimate.scaled[place] + offset) * free.scale, HELD * error * free.scale)
        problem.priors = {**given, name: held}
        scaled, cost, _ = fitted(problem, start, progress)
        problem.priors = given
        away = (scaled[place] * free.scale - held.mean) / held.deviation
        deviances.append((cost - away**2 - estimate.cost) * white / error**2)
    values = (estimate.scaled[place] + offsets) * free.scale
    found = np.array(deviances)
    best = estimate.values[name]
    return Profile(name, free.unit, best, error * free.scale, values, found)
