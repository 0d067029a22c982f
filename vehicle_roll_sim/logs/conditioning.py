"""Signals made comparable: gaps, one clock, a zero-phase filter, and the place of the sensor."""

import functools

import numpy as np

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.raw_log import Channel

LONGEST_GAP = 0.25
"""s: longer gaps are refused; shorter ones are filled by straight lines."""
GAP = 3.5
"""Times the usual interval: a longer one is a gap."""
ROUNDING = 1e-6
"""s: of times written with microseconds."""
ORDER = 2
"""Of the filter in each direction: forward and backward it has the magnitude of the order 4."""
FEWEST = 20
"""Samples of a log."""
PLACES = 6
"""Decimal places of the sampling interval (s)."""


def checked_times(time: np.ndarray, field: str) -> np.ndarray:
    """Which samples to keep, shape (n,): all but repeated times.

    time: s, shape (n,). Raises InputError naming `field` for times that are missing or step back.
    """
    if len(time) < FEWEST:
        raise InputError(field, "", f"at least {FEWEST} rows", f"{len(time)} rows")
    if not np.isfinite(time).all():
        row = int(np.argmin(np.isfinite(time)))
        raise InputError(field, float(time[row]), "a time in every row", f"none in row {row + 1}")
    steps = np.diff(time)
    if (steps < 0.0).any():
        row = int(np.argmax(steps < 0.0))
        problem = f"the clock steps back by {-steps[row]:g} s after {time[row] - time[0]:g} s"
        raise InputError(field, "", "times that increase: cut the log there", problem)
    return np.append(True, steps > 0.0)


def interval_of(time: np.ndarray) -> float:
    """The usual interval between times (s)."""
    return round(float(np.median(np.diff(time))), PLACES) or float(np.median(np.diff(time)))


def filled(channel: Channel, field: str) -> tuple[Channel, str]:
    """The channel with its missing values filled by straight lines, and a note on them.

    Raises InputError naming `field` for a gap longer than LONGEST_GAP, whether of missing values or
    of missing rows.
    """
    time, values = channel
    known = np.isfinite(values)
    if known.sum() < FEWEST:
        problem = f"{known.sum()} values"
        raise InputError(field, "", f"at least {FEWEST} values", problem)
    if not (known[0] and known[-1]):
        where = "first" if not known[0] else "last"
        raise InputError(field, "", "values from the first to the last row", f"none in the {where}")
    instants = time[known]
    steps = np.diff(instants)
    longest = int(np.argmax(steps))
    if steps[longest] > max(LONGEST_GAP, GAP * float(np.median(steps))):
        begin = instants[longest] - time[0]
        problem = f"a gap of {steps[longest]:.3g} s after {begin:.3g} s"
        allowed = f"gaps of at most {LONGEST_GAP:g} s: choose a part with --begin and --end"
        raise InputError(field, "", allowed, problem)
    gaps = int((steps > GAP * np.median(steps)).sum())
    note = f"{gaps} gaps of at most {steps[longest]:.3g} s filled" if gaps else ""
    if gaps == 1:
        note = f"1 gap of {steps[longest]:.3g} s filled"
    return (time, np.interp(time, instants, values[known])), note


def held(channel: Channel, grid: np.ndarray) -> np.ndarray:
    """The last value at or before each time of the grid (s), shape (n,): no look-ahead."""
    time, values = channel
    last = np.searchsorted(time, grid + ROUNDING, side="right") - 1
    return values[np.maximum(last, 0)]


def low_pass(values: np.ndarray, cutoff: float, interval: float) -> np.ndarray:
    """Zero-phase Butterworth filter. cutoff: Hz, 0 for none. interval: of the samples (s)."""
    if cutoff == 0.0:
        return values
    from scipy.signal import sosfiltfilt  # scipy takes 0.25 s to import

    return sosfiltfilt(_sections(cutoff, interval), values)


@functools.cache
def _sections(cutoff: float, interval: float) -> np.ndarray:
    """Second-order sections of the filter. Its design takes longer than a use of it."""
    from scipy.signal import butter  # scipy takes 0.25 s to import

    return butter(ORDER, cutoff, fs=1.0 / interval, output="sos")


def lateral_acceleration_at_cg(
    at_sensor: np.ndarray,
    rates: tuple[np.ndarray, np.ndarray, np.ndarray],
    place: tuple[float, float, float],
    interval: float,
) -> np.ndarray:
    """a - (dw/dt x r + w x (w x r)), its y component (m/s^2), shape (n,).

    rates: about x, y, z (rad/s), each (n,). place: of the sensor from the c.g. (m). interval: s.
    """
    x, y, z = place
    p, q, r = rates
    turning = np.gradient(r, interval) * x - np.gradient(p, interval) * z
    inward = p * q * x - (p**2 + r**2) * y + q * r * z
    return at_sensor - turning - inward


def sideslip_at_cg(
    at_sensor: np.ndarray,
    speed: np.ndarray,
    roll_rate: np.ndarray,
    yaw_rate: np.ndarray,
    place: tuple[float, float, float],
) -> np.ndarray:
    """Sideslip angle at the c.g. (rad), shape (n,), from that at a sensor.

    speed: forward at the c.g. (m/s). Rates: rad/s. place: of the sensor from the c.g. (m).
    """
    x, y, z = place
    lateral = np.tan(at_sensor) * (speed - yaw_rate * y) - yaw_rate * x + roll_rate * z
    return np.arctan2(lateral, speed)
