"""The numbers that are read off a run: peaks, events, oscillation, load transfer and gradients.

`time` is ascending (s), shape (n,), and the signals are sampled at these times: (n,), or (n, 4) for
the wheels lf, rf, lr, rr. Signs as everywhere: left turns give positive lateral acceleration and
positive roll (left side up); right turns give the same numbers with the other sign. What is not
found is nan. Samples that are nan are passed over where a peak, an extremum or an event is looked
for; a mean or slope of them is nan. Lengths that do not fit raise what numpy raises.
"""

import math
from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.model.records import LF, RF

LEFT, RIGHT = slice(LF, None, 2), slice(RF, None, 2)
"""Wheels of a side, front and rear."""
ROUNDING = 5e-7
"""s: more than times are rounded by, also those that count from 1970."""
STRAIGHT = 1e-6
"""m/s^2: a span of lateral accelerations below it is rounding; a slope over it would be noise."""
STANDSTILL = 0.1
"""m/s"""
CROSSINGS_OF_A_PERIOD = 3


def peak(time: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """The value of the largest magnitude with its sign, the first of equals, and its time (s).

    (nan, nan) without samples.
    """
    time, values = _known(time, values)
    if not len(values):
        return math.nan, math.nan
    largest = np.abs(values).argmax()
    return float(values[largest]), float(time[largest])


def steady(time: np.ndarray, values: np.ndarray, window: float = 0.5) -> float | np.ndarray:
    """Mean over the last `window` seconds, the sample at their very beginning not included.

    values: (n,), or (n, 4), for which the result is (4,). Of a shorter run the mean of all.
    """
    return _mean(values[time > time[-1:] - window + ROUNDING])


def rms(values: np.ndarray) -> float | np.ndarray:
    """Root of the mean square of evenly spaced samples; values and result as for `steady`."""
    return np.sqrt(_mean(np.square(values)))


def crossing_times(time: np.ndarray, values: np.ndarray, level: float = 0.0) -> np.ndarray:
    """All times (s) at which values pass the level from one side to the other, shape (crossings,).

    Interpolated linearly. Values that touch the level and turn back, or that begin or end on it,
    do not cross it; of several samples on the level between the two sides the first is the time.
    """
    time, above = _known(time, values - level)
    last, _ = _changes_of_sign(above)
    share = above[last] / (above[last] - above[last + 1])
    return time[last] + share * (time[last + 1] - time[last])


def damped_frequency(time: np.ndarray, roll_rate: np.ndarray, since: float) -> float:
    """Damped frequency of the roll (Hz): one period, from its first to its third extremum.

    The extrema are the zero crossings of the roll rate after `since` (s); nan if there are fewer.
    """
    crossings = crossing_times(time, roll_rate)
    crossings = crossings[crossings > since][:CROSSINGS_OF_A_PERIOD]
    if len(crossings) < CROSSINGS_OF_A_PERIOD:
        return math.nan
    return float(1 / (crossings[-1] - crossings[0]))


def damping_ratio(time: np.ndarray, roll: np.ndarray, since: float, final: float) -> float:
    """Damping ratio of the oscillation of the roll angle (rad) about `final` (rad).

    From the logarithmic decrement of two extrema half a period apart: the first after `since` (s)
    and beyond `final`, that is, after the roll angle has passed it; and the next, on the other
    side. Each is the vertex of the parabola through three samples. Negative if the oscillation
    grows, nan if there are not two extrema.
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
    """Load that has moved from left to right, front and rear (N): (..., 4) to (..., 2).

    loads: tire normal forces (N). Positive in a left turn.
    """
    return (loads[..., RIGHT] - loads[..., LEFT]) / 2


def load_transfer_ratio(loads: np.ndarray) -> float | np.ndarray:
    """(right - left) / total of the tire loads (N), -1 to 1: (..., 4) to (...).

    0 where no tire carries load; a float for a single set of four.
    """
    left, right = loads[..., LEFT].sum(axis=-1), loads[..., RIGHT].sum(axis=-1)
    total = left + right
    return np.divide(right - left, total, out=np.zeros(np.shape(total)), where=total != 0.0)[()]


def sideslip_angle(velocity: Sequence[np.ndarray], roll: np.ndarray, pitch: np.ndarray):
    """Angle (rad) from the heading to the way over the ground, left positive, shape (n,).

    velocity: u, v and w along the body's axes (m/s). nan for w and pitch is that of a model without
    heave and pitch, where both are 0. nan in standstill, where it is not defined.
    """
    u, v, w = velocity
    w, pitch = np.nan_to_num(w), np.nan_to_num(pitch)
    ahead = np.cos(pitch) * u + np.sin(pitch) * (np.sin(roll) * v + np.cos(roll) * w)
    left = np.cos(roll) * v - np.sin(roll) * w
    moves = np.hypot(ahead, left) >= STANDSTILL
    return np.arctan(np.divide(left, ahead, out=np.full(np.shape(ahead), np.nan), where=moves))


def lift_off_times(time: np.ndarray, loads: np.ndarray) -> np.ndarray:
    """Time (s) of the first sample at which each load is 0 after it was above, shape (4,).

    loads: tire normal forces (N), (n, 4). nan for a wheel that does not lift.
    """
    lifted = np.logical_or.accumulate(loads > 0.0) & (loads <= 0.0)
    first = np.where(lifted, time[:, np.newaxis], np.inf).min(axis=0, initial=np.inf)
    return np.where(lifted.any(axis=0), first, np.nan)


def rollover_time(time: np.ndarray, roll: np.ndarray, angle: float) -> float:
    """First time (s) at which the magnitude of roll reaches angle (both rad), else nan.

    Interpolated linearly; the first sample's time if it is there from the beginning.
    """
    time, roll = _known(time, roll)
    reached = np.flatnonzero(np.abs(roll) >= angle)
    if not len(reached):
        return math.nan
    there = reached[0]
    around = slice(max(there - 1, 0), there + 1)
    return float(np.interp(angle, np.sign(roll[there]) * roll[around], time[around]))


def roll_gradient(lateral_acceleration: np.ndarray, roll: np.ndarray) -> float:
    """Slope of the least-squares line of roll (rad) over lateral acceleration (m/s^2).

    rad/(m/s^2); nan without a turn.
    """
    return _slope(lateral_acceleration, roll)


def understeer_gradient(
    lateral_acceleration: np.ndarray,
    steering: np.ndarray,
    yaw_rate: np.ndarray,
    speed: np.ndarray | float,
    wheelbase: float,
) -> float:
    """Slope of the least-squares line of steering - wheelbase * yaw_rate / speed.

    Over lateral acceleration (m/s^2), thus rad/(m/s^2): positive if the vehicle understeers, nan
    without a turn. steering: road-wheel angle (rad); yaw_rate (rad/s); speed (m/s), not 0;
    wheelbase (m).
    """
    return _slope(lateral_acceleration, steering - wheelbase * yaw_rate / speed)


def _known(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    known = ~np.isnan(values)
    return time[known], values[known]


def _mean(values: np.ndarray) -> float | np.ndarray:
    """Over the first axis; nan, without a warning, of nothing."""
    return values.mean(axis=0) if len(values) else np.full(values.shape[1:], np.nan)[()]


def _changes_of_sign(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For each change, the last sample of the one sign and the first of the other."""
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
