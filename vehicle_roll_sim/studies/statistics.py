"""Probabilities, quantiles and shares of the variance, with their 95 % intervals."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from scipy import stats

CONFIDENCE = 0.95
RESAMPLES, SEED = 1000, 0
"""Of the bootstrap: the same results always give the same interval."""


class Interval(NamedTuple):
    """An estimate with its 95 % interval."""

    value: float
    low: float
    high: float


def probability(events: int, runs: int) -> Interval:
    """The probability of an event from independent runs, with Wilson's score interval.

    Wilson (1927), Journal of the American Statistical Association 22. runs: at least 1.
    """
    interval = stats.binomtest(events, runs).proportion_ci(CONFIDENCE, method="wilson")
    return Interval(events / runs, float(interval.low), float(interval.high))


def quantiles(values: np.ndarray, shares: Sequence[float]) -> list[Interval]:
    """The values (n,) below which these shares of all lie, with percentile bootstrap intervals."""
    again = np.array([np.quantile(values[drawn], shares) for drawn in _resamples(len(values))])
    found = np.quantile(values, shares)
    return [_interval(value, spread) for value, spread in zip(found, again.T, strict=True)]


def _resamples(size: int) -> Iterator[np.ndarray]:
    """Indices of RESAMPLES samples with replacement, one at a time: all together are large."""
    generator = np.random.default_rng(SEED)
    return (generator.integers(size, size=size) for _ in range(RESAMPLES))


class SobolIndices(NamedTuple):
    """Shares of the variance due to a factor, alone and including its interactions."""

    first: Interval
    total: Interval


def sobol_indices(values: np.ndarray, factors: int) -> list[SobolIndices]:
    """Sobol indices of each factor from the runs of `designs.saltelli`, shape (n (factors + 2),).

    First order as in Saltelli et al. (2010), Computer Physics Communications 181, table 2 b, total
    as in Jansen (1999), table 2 f; with percentile bootstrap intervals. nan if nothing varies.
    """
    first, second, *mixed = np.split(values, factors + 2)
    indices = []
    for each in mixed:
        whole = _indices(first, second, each)
        drawn = _resamples(len(first))
        again = np.array([_indices(first[one], second[one], each[one]) for one in drawn])
        pairs = zip(whole, again.T, strict=True)
        indices.append(SobolIndices(*(_interval(value, spread) for value, spread in pairs)))
    return indices


def _indices(first: np.ndarray, second: np.ndarray, mixed: np.ndarray) -> tuple:
    """First-order and total index."""
    mean = (first.mean() + second.mean()) / 2.0
    variance = np.var(np.concatenate([first, second]))
    with np.errstate(invalid="ignore", divide="ignore"):
        alone = ((second - mean) * (mixed - first)).mean() / variance
        return alone, ((first - mixed) ** 2).mean() / (2.0 * variance)


def _interval(value: float, again: np.ndarray) -> Interval:
    tail = (1.0 - CONFIDENCE) / 2.0
    low, high = np.quantile(again, (tail, 1.0 - tail))
    return Interval(float(value), float(low), float(high))
