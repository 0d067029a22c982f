"""How certain least-squares values are when the residuals are correlated in time.

The covariance is the sandwich H^-1 M H^-1 of H = J'J and M, the covariance of the gradient J'e.
M is that of residuals whose covariances over time, and between the quantities of a log, are those
that are found, and of what the noise of the steering and speed adds (input_noise.py). The window is
the flat-top one of Politis and Romano (1995), its width that of Politis (2003); the idea is that of
Newey and West (1987).
"""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

RUN = 5
"""Lags in a row that must be without correlation, for the width of the window."""
NOISE_LEVEL = 2.0
"""Standard errors of a correlation coefficient that count as none."""
LONGEST_SHARE = 0.25
"""Of a log: largest width of the window."""
ROUNDING = 1e-8
"""Of the largest singular value: a smaller one is that of rounding."""
CONFIDENCE = 0.95
LARGEST_ERROR = 0.5
"""Standard error over the scale of a value from which it counts as not identifiable."""


@dataclasses.dataclass(frozen=True)
class Combination:
    """A combination of values: `weights` over their scales, (p,), of length 1, and its error.

    singular_value: of the scaled sensitivities. error: standard error, over the scales.
    """

    weights: np.ndarray
    singular_value: float
    error: float

    @property
    def is_identifiable(self) -> bool:
        """Whether the logs say something of it."""
        return self.error < LARGEST_ERROR


@dataclasses.dataclass(frozen=True)
class Uncertainty:
    """Covariance of scaled values, (p, p), and what follows.

    naive: covariance if the residuals were white. effective: number of independent residuals.
    window: width over which residuals are correlated (s), of each log. combinations: from the most
    to the least certain one.
    """

    covariance: np.ndarray
    naive: np.ndarray
    effective: float
    window: list[float]
    combinations: list[Combination]

    @property
    def errors(self) -> np.ndarray:
        """Standard errors of the scaled values, (p,)."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def correlations(self) -> np.ndarray:
        """Correlation matrix, (p, p)."""
        return self.covariance / np.outer(self.errors, self.errors)

    @property
    def quantile(self) -> float:
        """Half width of a 95 % interval over the standard error (Student's t)."""
        from scipy.special import stdtrit  # scipy takes 0.25 s to import

        freedom = max(self.effective - len(self.covariance), 1.0)
        return float(stdtrit(freedom, (1.0 + CONFIDENCE) / 2.0))


@dataclasses.dataclass(frozen=True)
class Block:
    """One log: residuals over their spreads, (n, quantities), and their derivatives, (n,
    quantities, p). interval: between samples (s). drawn: changes of the residuals by draws of the
    noise that drives the model, (draws, n, quantities).
    """

    residuals: np.ndarray
    slopes: np.ndarray
    interval: float
    drawn: np.ndarray


def uncertainty_of(blocks: Sequence[Block], of_priors: np.ndarray) -> Uncertainty:
    """The uncertainty of values. of_priors: derivatives of the residuals of priors, (m, p)."""
    count = of_priors.shape[1]
    slopes = np.vstack([*(block.slopes.reshape(-1, count) for block in blocks), of_priors])
    inverse, values, directions, unknown = _inverse(slopes)
    windows = [window_of(block.residuals) for block in blocks]
    effective = sum(
        effective_number(block.residuals, width)
        for block, width in zip(blocks, windows, strict=True)
    )
    given = of_priors.T @ of_priors
    gradient = given + sum(
        _of_drawn(block) + _of_residuals(block, width) * _freedom(effective, count)
        for block, width in zip(blocks, windows, strict=True)
    )
    covariance = inverse @ gradient @ inverse + unknown
    spread = np.mean([np.mean(block.residuals**2) for block in blocks])
    combinations = [
        Combination(row, float(value), math.sqrt(max(row @ covariance @ row, 0.0)))
        for value, row in zip(values, directions, strict=True)
    ]
    seconds = [width * block.interval for block, width in zip(blocks, windows, strict=True)]
    return Uncertainty(covariance, inverse * spread, effective, seconds, combinations)


def _freedom(effective: float, count: int) -> float:
    """The factor by which the fit has made the residuals too small."""
    return effective / max(effective - count, 1.0)


def _inverse(slopes: np.ndarray) -> tuple[np.ndarray, ...]:
    """(J'J)^-1, singular values of J, their directions (rows), and what is not known at all.

    Singular values of rounding are raised to ROUNDING. What is not known at all is a covariance,
    (p, p), of their directions, in which the residuals say nothing: large and finite.
    """
    _, values, directions = np.linalg.svd(slopes, full_matrices=False)
    raised = np.maximum(values, ROUNDING * max(values[0], np.finfo(float).tiny))
    unknown = np.where(values < raised, 1.0 / raised**2, 0.0)
    inverse, unknown = ((directions.T * each) @ directions for each in (1.0 / raised**2, unknown))
    return inverse, values, directions, unknown


def newton_step(slopes: np.ndarray, residuals: np.ndarray) -> np.ndarray:
    """How far the derivatives, (n, p), say that the best values are away from these, (p,)."""
    return -_inverse(slopes)[0] @ (slopes.T @ residuals)


def autocorrelations(residuals: np.ndarray, longest: int) -> np.ndarray:
    """Autocorrelations for lags up to `longest`, shape (longest + 1, quantities)."""
    centred = residuals - residuals.mean(axis=0)
    found = np.array(
        [
            np.sum(centred[: len(centred) - lag] * centred[lag:], axis=0)
            for lag in range(longest + 1)
        ]
    )
    return found / np.maximum(found[0], np.finfo(float).tiny)


def window_of(residuals: np.ndarray) -> int:
    """Width of the window in samples: twice the lag after which there is no correlation."""
    count = len(residuals)
    longest = max(1, int(LONGEST_SHARE * count))
    found = np.abs(autocorrelations(residuals, longest))
    is_none = found < NOISE_LEVEL * math.sqrt(math.log10(count) / count)
    widths = [_first_run(column) for column in is_none[1:].T]
    return min(2 * max(widths), longest)


def _first_run(is_none: np.ndarray) -> int:
    """The lag before the first RUN lags in a row without correlation; at least 1."""
    for lag in range(len(is_none) - RUN + 1):
        if is_none[lag : lag + RUN].all():
            return max(lag, 1)
    return len(is_none)


def flat_top(lags: np.ndarray, width: int) -> np.ndarray:
    """1 up to half the width, then falling to 0."""
    return np.clip(2.0 * (1.0 - np.abs(lags) / max(width, 1)), 0.0, 1.0)


def effective_number(residuals: np.ndarray, width: int) -> float:
    """How many independent residuals have as much to say as these."""
    found = autocorrelations(residuals, width)
    weights = flat_top(np.arange(width + 1), width)[1:, np.newaxis]
    lengths = 1.0 + 2.0 * np.sum(weights * found[1:], axis=0)
    return float(np.sum(len(residuals) / np.maximum(lengths, 1.0)))


def _of_residuals(block: Block, width: int) -> np.ndarray:
    """Covariance of J'e of the residuals of one log, (p, p)."""
    errors, slopes = block.residuals - block.residuals.mean(axis=0), block.slopes
    count = len(errors)
    total = np.zeros((slopes.shape[2],) * 2)
    for lag in range(width + 1):
        weight = float(flat_top(np.array(lag), width)) if lag else 1.0
        earlier, later = slice(0, count - lag), slice(lag, count)
        between = errors[earlier].T @ errors[later] / count
        moved = (between @ slopes[later]).reshape(-1, len(total))
        part = slopes[earlier].reshape(-1, len(total)).T @ moved
        total += weight * (part + part.T if lag else part)
    return _semidefinite(total)


def _of_drawn(block: Block) -> np.ndarray:
    """Covariance of J'e by the noise that drives the model, (p, p)."""
    slopes = block.slopes.reshape(-1, block.slopes.shape[2])
    draws = block.drawn.reshape(len(block.drawn), len(slopes)) @ slopes
    return draws.T @ draws / max(len(draws), 1)


def _semidefinite(matrix: np.ndarray) -> np.ndarray:
    """The matrix without negative eigenvalues, which a flat-top window can leave."""
    values, vectors = np.linalg.eigh(matrix)
    return (vectors * np.maximum(values, 0.0)) @ vectors.T
