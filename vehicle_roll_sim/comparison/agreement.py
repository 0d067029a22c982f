"""How well two signals agree: errors, time shift, correlation and gain.

Signals are evenly sampled, (n,) each, without nan.
"""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.logs.doubts import correlation
from vehicle_roll_sim.runs.metrics import peak, rms

LARGEST_SHIFT = 0.5
"""s: largest time shift that is looked for."""
WEAK = 0.7
"""Correlation: a weaker one has no time shift and no gain."""
LONGEST_SHARE = 0.25
"""Of the signal: largest time shift."""


@dataclasses.dataclass(frozen=True)
class Agreement:
    """Simulated minus measured: rms, largest error and mean, in the unit of the signals.

    peak: largest measured magnitude. shift: how much later the measured signal comes (s).
    correlation, gain: of the signals with this shift removed; gain is simulated over measured.
    nan where there is none.
    """

    rms: float
    peak_error: float
    offset: float
    peak: float
    shift: float
    correlation: float
    gain: float


def agreement(measured: np.ndarray, simulated: np.ndarray, interval: float) -> Agreement:
    """Compare two signals with samples every `interval` (s)."""
    error = simulated - measured
    shift = time_shift(measured, simulated, interval)
    aligned = shifted(measured, 0.0 if math.isnan(shift) else -shift, interval)
    known = np.isfinite(aligned)
    strength = correlation(aligned[known], simulated[known])
    is_clear = strength >= WEAK
    return Agreement(
        rms=float(rms(error)),
        peak_error=float(np.abs(error).max()),
        offset=float(error.mean()),
        peak=abs(peak(np.arange(len(measured)), measured)[0]),
        shift=shift,
        correlation=strength,
        gain=_gain(aligned[known], simulated[known]) if is_clear else math.nan,
    )


def time_shift(measured: np.ndarray, simulated: np.ndarray, interval: float) -> float:
    """How much later the measured signal comes (s), by the maximum of the cross-correlation.

    Each shift is judged by the correlation coefficient of the samples that then overlap; between
    samples by a parabola. nan if the maximum is weak or at the largest shift.
    """
    most = min(round(LARGEST_SHIFT / interval), int(LONGEST_SHARE * len(measured)))
    lags = np.arange(-most, most + 1)
    found = np.array([_correlation_at(measured, simulated, lag) for lag in lags])
    if not np.isfinite(found).all():
        return math.nan
    best = int(found.argmax())
    if found[best] < WEAK or best in (0, len(lags) - 1):
        return math.nan
    before, here, after = found[best - 1 : best + 2]
    curvature = before - 2.0 * here + after
    between = 0.5 * (before - after) / curvature if curvature < 0.0 else 0.0
    return float((lags[best] + between) * interval)


def _correlation_at(measured: np.ndarray, simulated: np.ndarray, lag: int) -> float:
    """Correlation with the measured signal `lag` samples earlier."""
    count = len(measured) - abs(lag)
    later, earlier = max(lag, 0), max(-lag, 0)
    return correlation(measured[later : later + count], simulated[earlier : earlier + count])


def shifted(values: np.ndarray, later: float, interval: float) -> np.ndarray:
    """The signal moved by `later` (s), interpolated linearly; nan where it then is unknown."""
    places = np.arange(len(values)) - later / interval
    return np.interp(places, np.arange(len(values)), values, left=math.nan, right=math.nan)


def _gain(measured: np.ndarray, simulated: np.ndarray) -> float:
    """Simulated over measured, from the regression of the measured on the simulated signal.

    The noise is in the measured signal, so that it does not bias this slope.
    """
    deviation = simulated - simulated.mean()
    return float(deviation @ deviation / (deviation @ (measured - measured.mean())))
