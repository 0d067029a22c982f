"""Probabilities, quantiles and shares of the variance, with their 95 % intervals."""

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


def quantile(values: np.ndarray, share: float) -> Interval:
    """The value (n,) below which a share of all lies, with its percentile bootstrap interval."""
    generator = np.random.default_rng(SEED)
    drawn = generator.integers(len(values), size=(RESAMPLES, len(values)))
    return _interval(np.quantile(values, share), np.quantile(values[drawn], share, axis=1))


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
    drawn = np.random.default_rng(SEED).integers(len(first), size=(RESAMPLES, len(first)))
    indices = []
    for each in mixed:
        whole = _indices(first, second, each)
        again = _indices(first[drawn], second[drawn], each[drawn])
        pairs = zip(whole, again, strict=True)
        indices.append(SobolIndices(*(_interval(value, spread) for value, spread in pairs)))
    return indices


def _indices(first: np.ndarray, second: np.ndarray, mixed: np.ndarray) -> tuple:
    """First-order and total index along the last axis."""
    mean = (first.mean(axis=-1) + second.mean(axis=-1)) / 2.0
    variance = np.var(np.concatenate([first, second], axis=-1), axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        centred = second - mean[..., np.newaxis]
        alone = (centred * (mixed - first)).mean(axis=-1) / variance
        return alone, ((first - mixed) ** 2).mean(axis=-1) / (2.0 * variance)


def _interval(value: float, again: np.ndarray) -> Interval:
    tail = (1.0 - CONFIDENCE) / 2.0
    low, high = np.quantile(again, (tail, 1.0 - tail))
    return Interval(float(value), float(low), float(high))
