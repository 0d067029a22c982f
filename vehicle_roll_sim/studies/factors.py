"""What is varied and how: lists and grids of values, and distributions."""

import abc
import dataclasses
import math

import numpy as np
from scipy import stats

from vehicle_roll_sim.declaration import InputError, keep_validated, parameter, parameters_of
from vehicle_roll_sim.studies.source import whole

MOST_VALUES = 10_000
LEAST_SHARE = 1e-6
"""Of a normal distribution that its bounds must leave: draws from less are inaccurate."""


@dataclasses.dataclass(frozen=True)
class Levels:
    """Values that are all run: numbers, or names of variants."""

    values: tuple


@dataclasses.dataclass(frozen=True)
class Grid:
    """Evenly spaced values, all of which are run. Raises InputError."""

    lowest: float = parameter("lowest value")
    highest: float = parameter("highest value")
    count: float = parameter("number of values", "", 2, MOST_VALUES)

    def __post_init__(self):
        keep_validated(self)
        _check_order(self, "lowest", "highest")
        whole(self.count, "count", "a whole number")
        with np.errstate(all="ignore"):
            values = self.values
        if len(set(values)) < len(values) or not np.isfinite(values).all():
            allowed = f"values that can be told apart and are finite, from {self.lowest:g}"
            raise InputError("highest", self.highest, allowed)

    @property
    def values(self) -> tuple[float, ...]:
        """All values, rounded to 12 digits: 0.7 rather than 0.7000000000000001."""
        evenly = np.linspace(self.lowest, self.highest, int(self.count))
        return tuple(float(f"{value:.12g}") for value in evenly)

    @property
    def limits(self) -> dict[str, float]:
        return {"lowest": self.lowest, "highest": self.highest}


@dataclasses.dataclass(frozen=True)
class Distribution(abc.ABC):
    """A distribution of the values of a factor. Raises InputError for inconsistent parameters."""

    def __post_init__(self):
        given = {name: getattr(self, name) for name in parameters_of(self)}
        keep_validated(self, {name: value for name, value in given.items() if value is not None})
        self.check()
        try:
            with np.errstate(all="ignore"):
                low, high = self.at(np.array([0.01, 0.99]))
        except OverflowError:
            low = high = math.inf
        if not (low < high and math.isfinite(high - low)):
            name, value = [each for each in given.items() if each[1] is not None][-1]
            problem = f"draws lie between {low:g} and {high:g}"
            raise InputError(name, value, "parameters whose draws are finite and differ", problem)

    @abc.abstractmethod
    def check(self) -> None:
        """Raise InputError for parameters that contradict each other."""

    @property
    def limits(self) -> dict[str, float]:
        """The bounds of all values, those that there are, by name."""
        bounds = {name: getattr(self, name, None) for name in ("lowest", "highest")}
        return {name: value for name, value in bounds.items() if value is not None}

    @abc.abstractmethod
    def at(self, shares: np.ndarray) -> np.ndarray:
        """The values below which a value lies with these probabilities, both of shape (n,)."""


@dataclasses.dataclass(frozen=True)
class Uniform(Distribution):
    lowest: float = parameter("lowest value")
    highest: float = parameter("highest value")

    def check(self) -> None:
        _check_order(self, "lowest", "highest")

    def at(self, shares: np.ndarray) -> np.ndarray:
        return self.lowest + shares * (self.highest - self.lowest)


@dataclasses.dataclass(frozen=True)
class Normal(Distribution):
    """A normal distribution, cut off at the bounds that are given."""

    mean: float = parameter("mean, before anything is cut off")
    sd: float = parameter("standard deviation", "", 0.0)
    lowest: float | None = parameter("bound below which there are no values", default=None)
    highest: float | None = parameter("bound above which there are no values", default=None)

    def check(self) -> None:
        _check_positive(self, "sd")
        if None not in (self.lowest, self.highest):
            _check_order(self, "lowest", "highest")
        below, above = self._shares()
        if above - below < LEAST_SHARE:
            name = "highest" if self.lowest is None else "lowest"
            allowed = f"bounds with a probability of at least {LEAST_SHARE:g} between them"
            raise InputError(name, getattr(self, name), allowed)

    def _shares(self) -> tuple[float, float]:
        """The probabilities of values below the bounds."""
        low = -math.inf if self.lowest is None else self.lowest
        high = math.inf if self.highest is None else self.highest
        with np.errstate(all="ignore"):
            below, above = (stats.norm.cdf(bound, self.mean, self.sd) for bound in (low, high))
        return float(below), float(above)

    def at(self, shares: np.ndarray) -> np.ndarray:
        bounds = (-math.inf if self.lowest is None else self.lowest, self.highest)
        below, above = self._shares()
        values = stats.norm.ppf(below + shares * (above - below), self.mean, self.sd)
        return np.clip(values, bounds[0], math.inf if self.highest is None else self.highest)


@dataclasses.dataclass(frozen=True)
class LogNormal(Distribution):
    """A lognormal distribution with mean and standard deviation of the value, not its logarithm."""

    mean: float = parameter("mean of the value", "", 0.0)
    sd: float = parameter("standard deviation of the value", "", 0.0)

    def check(self) -> None:
        _check_positive(self, "mean")
        _check_positive(self, "sd")

    def at(self, shares: np.ndarray) -> np.ndarray:
        variance = math.log1p((self.sd / self.mean) ** 2)
        middle = math.log(self.mean) - variance / 2.0
        return np.exp(stats.norm.ppf(shares, middle, math.sqrt(variance)))


@dataclasses.dataclass(frozen=True)
class Triangular(Distribution):
    lowest: float = parameter("lowest value")
    mode: float = parameter("most likely value")
    highest: float = parameter("highest value")

    def check(self) -> None:
        _check_order(self, "lowest", "highest")
        if not self.lowest <= self.mode <= self.highest:
            allowed = f"a number from lowest, {self.lowest:g}, to highest, {self.highest:g}"
            raise InputError("mode", self.mode, allowed)

    def at(self, shares: np.ndarray) -> np.ndarray:
        width = self.highest - self.lowest
        return stats.triang.ppf(shares, (self.mode - self.lowest) / width, self.lowest, width)


DISTRIBUTIONS = {
    "uniform": Uniform,
    "normal": Normal,
    "lognormal": LogNormal,
    "triangular": Triangular,
}
Factor = Levels | Grid | Distribution


def _check_order(factor, lower: str, upper: str) -> None:
    """Raise InputError unless one bound is below the other."""
    if not getattr(factor, lower) < getattr(factor, upper):
        allowed = f"more than {lower}, {getattr(factor, lower):g}"
        raise InputError(upper, getattr(factor, upper), allowed)


def _check_positive(factor, name: str) -> None:
    if not getattr(factor, name) > 0.0:
        raise InputError(name, getattr(factor, name), "a number above 0")
