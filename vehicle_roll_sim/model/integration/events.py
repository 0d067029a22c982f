"""What happens on the way: wheels lift, the vehicle rolls over, a run must stop; and the peaks."""

import enum

import numpy as np

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.records import STATE, STATE_SIZE, WHEEL_COUNT, per_wheel, record_dtype

MINIMUM_SPEED = 3.5
"""Lowest forward speed (m/s) of the model: the slip of equation 5 divides by it."""
SPEED_ROUNDING = 1e-9
"""Relative allowance for rounding, so that a run at exactly the lowest speed goes on."""


class Condition(enum.IntEnum):
    """Whether a run can go on, and if not, why."""

    RUNNING = 0
    ROLLED_OVER = 1
    TOO_SLOW = 2
    DIVERGED = 3


VALUE, TIME = 0, 1
SLIP_RATIO, SLIP_ANGLE, NORMAL_FORCE = 0, 1, 2

EVENTS = record_dtype(
    *per_wheel("lift_off_time"),
    *per_wheel("support"),
    ("rollover_time", (1,)),
    ("peak_roll", 2),
    ("peak_lateral_acceleration", 2),
    ("out_of_range_time", 3),
)
"""Times (s) are nan until the event. lift_off_time: the first time that Fz reaches 0, and
rollover_time: that the roll angle reaches its limit, both interpolated linearly between steps.
support: of each wheel (N), as last noted. Peaks are (value, time) of the largest magnitude at the
steps. out_of_range_time: when slip ratio, slip angle or load of any loaded tire first left the
range of the tire file."""

LIMITS = record_dtype("rollover_angle", "minimum_speed", ("largest", STATE_SIZE))
"""Where a run stops: roll angle (rad), forward speed (m/s) and the largest plausible magnitude of
every state."""


def plausible_magnitudes() -> np.ndarray:
    """Largest magnitude of each state that a road vehicle can show: one STATE record in an array.

    Beyond it is divergence. Distances and angles that only add up have one, too: a day at their
    largest rates is less, and where a double has steps of 0.1 mm nothing is integrated any more.
    """
    largest = np.zeros(1, STATE)
    bound = largest[0]
    bound.x = bound.y = bound.yaw = bound.wheel_angle = 1e12
    bound.z = 1e3
    bound.roll = math.pi
    bound.pitch = 1.55  # short of the singularity of the Euler angles
    bound.u = bound.v = bound.w = 1e3
    bound.roll_rate = bound.pitch_rate = bound.yaw_rate = 1e3
    bound.suspension_compression = bound.tire_compression = 1e2
    bound.unsprung_velocity = 1e3
    bound.wheel_speed = 1e6
    bound.longitudinal_slip = bound.lateral_slip = 1e3
    return largest


def no_events() -> np.ndarray:
    """An EVENTS record, in an array, in which nothing has happened yet."""
    events = np.full(1, np.nan, EVENTS)
    events[0].peak_roll = events[0].peak_lateral_acceleration = 0.0
    return events


@kernel
def crossing_time(time, step, before, after):
    """When a quantity that is `before` at `time` and `after` a step later passes 0 (s)."""
    return time + step * before / (before - after)


@kernel
def note_peaks(time, state, tire, outputs, events):
    """Largest roll angle and lateral acceleration so far, and tires beyond their ranges."""
    keep_peak(time, state[at.ROLL], events.peak_roll)
    keep_peak(time, outputs.acceleration[1], events.peak_lateral_acceleration)
    for i in range(WHEEL_COUNT):
        fz = outputs.normal_force[i]
        if fz > 0.0:
            kappa, alpha = outputs.slip_ratio[i], outputs.slip_angle[i]
            noted = events.out_of_range_time
            note_range(time, kappa, tire.KPUMIN, tire.KPUMAX, noted, SLIP_RATIO)
            note_range(time, alpha, tire.ALPMIN, tire.ALPMAX, noted, SLIP_ANGLE)
            note_range(time, fz, tire.FZMIN, tire.FZMAX, noted, NORMAL_FORCE)


@kernel
def keep_peak(time, value, peak):
    if math.isfinite(value) and abs(value) > abs(peak[VALUE]):
        peak[VALUE], peak[TIME] = value, time


@kernel
def note_range(time, value, lowest, highest, noted, quantity):
    if math.isnan(noted[quantity]) and not lowest <= value <= highest:
        noted[quantity] = time


@kernel
def note_lift_offs(time, step, support, events):
    """Wheels whose support passed 0 in the step (s) from `time` on; 0: at once, by a command."""
    for i in range(WHEEL_COUNT):
        before = events.support[i]
        if support[i] <= 0.0 < before and math.isnan(events.lift_off_time[i]):
            events.lift_off_time[i] = crossing_time(time, step, before, support[i])
        events.support[i] = support[i]


@kernel
def note_rollover(time, step, roll_before, roll, rollover_angle, events):
    """Rollover during the step that began at `time` with the roll angle `roll_before` (rad)."""
    left, gone = rollover_angle - abs(roll_before), rollover_angle - abs(roll)
    if gone <= 0.0 < left:
        events.rollover_time[0] = crossing_time(time, step, left, gone)


@kernel
def most_implausible(state, largest):
    """Index of the state furthest beyond its bound, or not finite; -1 if all are plausible.

    A state without a bound (nan) is one that the model does not have.
    """
    worst, culprit = 1.0, -1
    for i in range(len(state)):
        if abs(state[i]) <= largest[i]:
            continue
        excess = abs(state[i]) / largest[i]
        if not math.isfinite(state[i]) and not math.isnan(largest[i]):
            excess = math.inf
        if excess > worst:
            worst, culprit = excess, i
    return culprit


@kernel
def without_rate(rates, largest):
    """Index of the first state whose rate is not finite; -1 if there is none."""
    for i in range(len(rates)):
        if not math.isfinite(rates[i]) and not math.isnan(largest[i]):
            return i
    return -1


@kernel
def condition_of(state, limits):
    """Whether the run can go on from `state`."""
    if abs(state[at.ROLL]) >= limits.rollover_angle:
        return Condition.ROLLED_OVER
    if state[at.U] < limits.minimum_speed * (1 - SPEED_ROUNDING):
        return Condition.TOO_SLOW
    return Condition.RUNNING
