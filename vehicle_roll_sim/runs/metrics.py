"""Metrics of a run: peaks, events, oscillation, load transfer and gradients.

`time` is ascending (s), shape (n,). Signals are sampled at these times: shape (n,), or (n, 4) for
the wheels lf, rf, lr, rr. A left turn gives positive lateral acceleration and positive roll (left
side up); a right turn gives the same values with the opposite sign. The result is nan if there is
none. Samples that are nan are ignored in the search for peaks, extrema and events, but make a mean
or slope nan. Mismatched lengths raise numpy's exceptions.
"""

import math
from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.model.records import LF, LR, RF, RR

LEFT, RIGHT = slice(LF, None, 2), slice(RF, None, 2)
"""Wheels of each side, front and rear."""
ROUNDING = 5e-7
"""s: larger than the rounding error of times, including times since 1970."""
STRAIGHT = 1e-6
"""m/s^2: a smaller range of lateral acceleration is rounding; a slope over it would be noise."""
STANDSTILL = 0.1
"""m/s"""
CROSSINGS_OF_A_PERIOD = 3
TWO_INCHES = 0.0508
"""m"""


def peak(time: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """The signed value of the largest magnitude, and its time (s); the first one of equals.

    (nan, nan) without samples.
    """
    time, values = _known(time, values)
    if not len(values):
        return math.nan, math.nan
    largest = np.abs(values).argmax()
    return float(values[largest]), float(time[largest])


def steady(time: np.ndarray, values: np.ndarray, window: float = 0.5) -> float | np.ndarray:
    """Mean over the last `window` (s), excluding a sample exactly at its beginning.

    values: (n,), or (n, 4), for which the result is (4,). For a shorter run, the mean of all.
    """
    return _mean(values[time > time[-1:] - window + ROUNDING])


def rms(values: np.ndarray) -> float | np.ndarray:
    """Root mean square of evenly spaced samples; values and result as for `steady`."""
    return np.sqrt(_mean(np.square(values)))


def crossing_times(time: np.ndarray, values: np.ndarray, level: float = 0.0) -> np.ndarray:
    """All times (s) at which values cross the level, shape (crossings,), interpolated linearly.

    Touching the level and turning back, or beginning or ending on it, is not a crossing. If several
    samples lie on the level between the two sides, the time is that of the first.
    """
    time, above = _known(time, values - level)
    last, _ = _changes_of_sign(above)
    share = above[last] / (above[last] - above[last + 1])
    return time[last] + share * (time[last + 1] - time[last])


def damped_frequency(time: np.ndarray, roll_rate: np.ndarray, since: float) -> float:
    """Damped roll frequency (Hz), from one period between the first and the third extremum.

    The extrema are zero crossings of the roll rate (any unit) after `since` (s); nan if there are
    fewer than three.
    """
    crossings = crossing_times(time, roll_rate)
    crossings = crossings[crossings > since][:CROSSINGS_OF_A_PERIOD]
    if len(crossings) < CROSSINGS_OF_A_PERIOD:
        return math.nan
    return float(1 / (crossings[-1] - crossings[0]))


def damping_ratio(time: np.ndarray, roll: np.ndarray, since: float, final: float) -> float:
    """Damping ratio of the oscillation of the roll angle (rad) about `final` (rad).

    From the logarithmic decrement of two extrema half a period apart: the first one after `since`
    (s) and after the roll angle has crossed `final`, and the next one on the other side. Each is
    the vertex of a parabola through three samples. Negative if the oscillation grows; nan if there
    are not two extrema.
    """
    time, beyond = _known(time, roll - final)
    last, first = _changes_of_sign(beyond)
    swings = zip(first, np.append(last[1:] + 1, len(beyond)), strict=False)
    furthest = [begin + np.abs(beyond[begin:end]).argmax() for begin, end in swings]
    extrema = [i for i in furthest if time[i] > since and i + 1 < len(time)][:2]
    if len(extrema) < 2:
        return math.nan
    one, other = (abs(_vertex(time, beyond, i)) for i in extrema)
    decrement = math.log(one / other)
    return decrement / math.hypot(math.pi, decrement)


def load_transfer(loads: np.ndarray) -> np.ndarray:
    """Lateral load transfer from left to right, front and rear (N): (..., 4) to (..., 2).

    loads: normal loads (N). Positive in a left turn.
    """
    return (loads[..., RIGHT] - loads[..., LEFT]) / 2


def load_transfer_ratio(loads: np.ndarray) -> float | np.ndarray:
    """(right - left) / total of the normal loads (N), -1 to 1: (..., 4) to (...).

    0 if no tire carries load; a float for a single set of four.
    """
    left, right = loads[..., LF] + loads[..., LR], loads[..., RF] + loads[..., RR]
    total = left + right
    return np.divide(right - left, total, out=np.zeros(np.shape(total)), where=total != 0.0)[()]


def wheel_lift(tire_compression: np.ndarray) -> np.ndarray:
    """Distance (m) of each tire from the road, 0 in contact; the same shape.

    tire_compression: against the road (m), negative off it; nan gives nan.
    """
    return np.maximum(-tire_compression, 0.0) + 0.0  # without the sign of a negative zero


def two_wheel_lift_time(time: np.ndarray, wheel_lift: np.ndarray) -> float:
    """Time (s) of the first sample with both wheels of one side at least 2 inches off the ground.

    wheel_lift: (n, 4) (m), nan in a model without it, which gives nan.
    """
    is_off = wheel_lift >= TWO_INCHES
    lifted = (is_off[:, LF] & is_off[:, LR]) | (is_off[:, RF] & is_off[:, RR])
    return float(time[np.argmax(lifted)]) if lifted.any() else math.nan


def sideslip_angle(velocity: Sequence[np.ndarray], roll: np.ndarray, pitch: np.ndarray):
    """Sideslip angle (rad): from the heading to the course over ground, left positive, shape (n,).

    velocity: u, v and w along the body axes (m/s). roll, pitch: rad. nan for w and pitch, as in a
    model without heave and pitch, counts as 0. The result is nan at standstill and at
    an infinite roll angle.
    """
    u, v, w = velocity
    w, pitch = np.nan_to_num(w), np.nan_to_num(pitch)
    with np.errstate(invalid="ignore"):
        ahead = np.cos(pitch) * u + np.sin(pitch) * (np.sin(roll) * v + np.cos(roll) * w)
        left = np.cos(roll) * v - np.sin(roll) * w
    moves = np.hypot(ahead, left) >= STANDSTILL
    return np.arctan(np.divide(left, ahead, out=np.full(np.shape(ahead), np.nan), where=moves))


def lift_off_times(time: np.ndarray, loads: np.ndarray) -> np.ndarray:
    """Time (s) of the first sample at which each load is 0 after being positive, shape (4,).

    loads: normal loads (N), (n, 4). nan for a wheel that does not lift off.
    """
    lifted = np.logical_or.accumulate(loads > 0.0) & (loads <= 0.0)
    first = np.where(lifted, time[:, np.newaxis], np.inf).min(axis=0, initial=np.inf)
    return np.where(lifted.any(axis=0), first, np.nan)


def rollover_time(time: np.ndarray, roll: np.ndarray, angle: float) -> float:
    """First time (s) at which the magnitude of the roll angle reaches `angle` (both rad), else nan.

    Interpolated linearly; the time of the first sample if it is reached from the beginning.
    """
    time, roll = _known(time, roll)
    reached = np.flatnonzero(np.abs(roll) >= angle)
    if not len(reached):
        return math.nan
    there = reached[0]
    around = slice(max(there - 1, 0), there + 1)
    return float(np.interp(angle, np.sign(roll[there]) * roll[around], time[around]))


def roll_gradient(lateral_acceleration: np.ndarray, roll: np.ndarray) -> float:
    """Least-squares slope of roll angle (rad) over lateral acceleration (m/s^2), both (n,).

    In rad/(m/s^2); nan without a turn.
    """
    return _slope(lateral_acceleration, roll)


def understeer_gradient(
    lateral_acceleration: np.ndarray,
    steering: np.ndarray,
    yaw_rate: np.ndarray,
    speed: np.ndarray | float,
    wheelbase: float,
) -> float:
    """Least-squares slope of steering - wheelbase * yaw_rate / speed over lateral acceleration.

    In rad/(m/s^2): positive if the vehicle understeers, nan without a turn. lateral_acceleration:
    m/s^2. steering: road-wheel angle (rad). yaw_rate: rad/s. speed: m/s, not 0. wheelbase: m.
    """
    return _slope(lateral_acceleration, steering - wheelbase * yaw_rate / speed)


def _known(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    known = ~np.isnan(values)
    return time[known], values[known]


def _mean(values: np.ndarray) -> float | np.ndarray:
    """Mean over the first axis; nan, without a warning, if it is empty."""
    return values.mean(axis=0) if len(values) else np.full(values.shape[1:], np.nan)[()]


def _changes_of_sign(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For each change of sign, the last sample before it and the first after it."""
    signed = np.flatnonzero(values)
    changes = np.flatnonzero(np.diff(np.sign(values[signed])))
    return signed[changes], signed[changes + 1]


def _vertex(time: np.ndarray, values: np.ndarray, i: int) -> float:
    """Value at the vertex of the parabola through sample i and its neighbours."""
    three = slice(i - 1, i + 2)
    curve, slope, value = np.polyfit(time[three] - time[i], values[three], 2)
    return value - slope**2 / (4 * curve)


def _slope(lateral_acceleration: np.ndarray, angle: np.ndarray) -> float:
    if not len(lateral_acceleration) or np.ptp(lateral_acceleration) < STRAIGHT:
        return math.nan
    deviation = lateral_acceleration - lateral_acceleration.mean()
    return float(deviation @ (angle - angle.mean()) / (deviation @ deviation))
