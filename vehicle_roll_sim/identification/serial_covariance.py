"""Covariances of residuals over time, and of the gradient J'e that follows from them.

The window is the flat-top one of Politis and Romano (1995), its width that of Politis (2003). What
a fit leaves is less than the noise, and least where the values act, which is slow: covariances are
corrected for it as Worsley et al. (NeuroImage 15, 2002) do.
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
ROUNDS = 8
"""Of the correction; each halves what is missing, or better, if the values are few."""


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


def gradient_covariance(
    blocks: Sequence[Block], widths: Sequence[int], inverse: np.ndarray, given: np.ndarray
) -> np.ndarray:
    """Covariance of J'e by the noise of which a fit has left the residuals, (p, p).

    widths: of the windows in samples. inverse: (J'J)^-1. given: covariance of J'e by priors.

    A fit makes e = n - J (J'J)^-1 J'n of the noise n. With covariances V of n, those of e are
    V - J W' - W J' + J C J' with W = V J (J'J)^-1 and the covariance C of the values; their means
    along the log are what is found. V is found by turns with W and C.
    """
    errors = [block.residuals - block.residuals.mean(axis=0) for block in blocks]
    found = [_lag_means(e, e, width) for e, width in zip(errors, widths, strict=True)]
    noise = found
    for _ in range(ROUNDS):
        spread = [_spread(b.slopes, each) for b, each in zip(blocks, noise, strict=True)]
        covariance = inverse @ (_gradient(blocks, spread) + given) @ inverse
        noise = [
            each + _taken(block.slopes, by @ inverse, covariance, len(each) - 1)
            for block, by, each in zip(blocks, spread, found, strict=True)
        ]
    spread = [_spread(b.slopes, each) for b, each in zip(blocks, noise, strict=True)]
    return _gradient(blocks, spread)


def _gradient(blocks: Sequence[Block], spread: Sequence[np.ndarray]) -> np.ndarray:
    """J'VJ, (p, p). spread: VJ of each log, (n, quantities, p)."""
    pairs = zip(blocks, spread, strict=True)
    return _semidefinite(sum(np.tensordot(b.slopes, by, ((0, 1), (0, 1))) for b, by in pairs))


def _taken(
    slopes: np.ndarray, spread: np.ndarray, covariance: np.ndarray, width: int
) -> np.ndarray:
    """What a fit takes of the covariances of a log, (width + 1, quantities, quantities)."""
    both = _lag_means(slopes, spread, width) + _lag_means(spread, slopes, width)
    return both - _lag_means(slopes @ covariance, slopes, width)


def _lag_means(first: np.ndarray, second: np.ndarray, width: int) -> np.ndarray:
    """Means of products, the second one later by 0 to width samples, (width + 1, q, q).

    first, second: shapes (n, q) or (n, q, p); products are summed over p.
    """
    count = len(first)
    size = count + width
    shape = (count, first.shape[1], -1)
    ahead, behind = (np.fft.rfft(each.reshape(shape), size, axis=0) for each in (first, second))
    sums = np.fft.irfft(ahead.conj() @ behind.transpose(0, 2, 1), size, axis=0)[: width + 1]
    return sums / (count - np.arange(width + 1))[:, np.newaxis, np.newaxis]


def _spread(slopes: np.ndarray, covariances: np.ndarray) -> np.ndarray:
    """VJ: slopes, (n, q, p), times the covariances of lags from 0 on, within the window."""
    width = len(covariances) - 1
    size = len(slopes) + width
    kernel = np.zeros((size, *covariances.shape[1:]))
    weights = flat_top(np.arange(1, width + 1), width)[:, np.newaxis, np.newaxis]
    kernel[: width + 1] = covariances
    kernel[1 : width + 1] *= weights
    kernel[size - width :] += kernel[width:0:-1].transpose(0, 2, 1)
    moved = np.fft.rfft(kernel, axis=0).conj() @ np.fft.rfft(slopes, size, axis=0)
    return np.fft.irfft(moved, size, axis=0)[: len(slopes)]


def _semidefinite(matrix: np.ndarray) -> np.ndarray:
    """The matrix without negative eigenvalues, which a flat-top window can leave."""
    values, vectors = np.linalg.eigh(matrix)
    return (vectors * np.maximum(values, 0.0)) @ vectors.T
