"""Events and peaks of a run: wheel lift-off, rollover, and the conditions that stop it."""

import enum

import numpy as np

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.layout import record_dtype
from vehicle_roll_sim.model.records import LR, STATE, STATE_SIZE, WHEEL_COUNT, per_wheel

MINIMUM_SPEED = 3.5
"""m/s: minimum forward speed with steady-state slip, since equation 5 divides by the speed."""
SPEED_ROUNDING = 1e-9
"""Relative rounding tolerance, so that a run at exactly the minimum speed continues."""


class Condition(enum.IntEnum):
    """Whether a run can continue, and if not, why."""

    RUNNING = 0
    ROLLED_OVER = 1
    TOO_SLOW = 2
    DIVERGED = 3


VALUE, TIME = 0, 1
SLIP_RATIO, SLIP_ANGLE, NORMAL_FORCE, INCLINATION = 0, 1, 2, 3

EVENTS = record_dtype(
    *per_wheel("lift_off_time"),
    *per_wheel("support"),
    ("rollover_time", (1,)),
    ("peak_roll", 2),
    ("peak_lateral_acceleration", 2),
    ("out_of_range_time", 4),
)
"""Events and peaks of a run; times (s) are nan until the event.

lift_off_time: first time at which the normal load of each wheel reaches 0. rollover_time: first
time at which the roll angle reaches its limit. Both are interpolated linearly between steps.
support: of each wheel at the last step (N). peak_roll, peak_lateral_acceleration: signed value
(rad, m/s^2) and time of the largest magnitude at the steps. out_of_range_time: first time at which
the slip ratio, slip angle, load or inclination of any loaded tire leaves the range of the tire
file; inclination counts for tires that depend on it only.
"""

LIMITS = record_dtype("rollover_angle", "stop_angle", "minimum_speed", ("largest", STATE_SIZE))
"""Roll angle that counts as a rollover (rad), and limits at which a run stops: roll angle (rad, inf
if it goes on after a rollover), forward speed (m/s), and the largest plausible magnitude of every
state (SI units)."""


def plausible_magnitudes() -> np.ndarray:
    """Largest plausible magnitude of each state for a road vehicle: an array of one STATE record.

    Larger magnitudes count as divergence. Accumulating distances and angles have limits as well: a
    day at their largest rates stays below, and at the limit the resolution of a double is 0.1 mm.
    """
    return _MAGNITUDES.copy()


def _plausible_magnitudes() -> np.ndarray:
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
    """An array of one EVENTS record without any event."""
    return _NO_EVENTS.copy()


def _no_events() -> np.ndarray:
    events = np.full(1, np.nan, EVENTS)
    events[0].peak_roll = events[0].peak_lateral_acceleration = 0.0
    return events


_MAGNITUDES, _NO_EVENTS = _plausible_magnitudes(), _no_events()


@kernel
def crossing_time(time, step, before, after):
    """Time (s) at which a quantity crosses 0, from its values before and after a step (s)."""
    return time + step * before / (before - after)


@kernel
def note_peaks(time, state, tires, outputs, events):
    """Update the peaks of roll angle and lateral acceleration, and the tire range events.

    tires: the TIRES record.
    """
    keep_peak(time, state[at.ROLL], events.peak_roll)
    keep_peak(time, outputs.acceleration[1], events.peak_lateral_acceleration)
    for i in range(WHEEL_COUNT):
        fz, tire = outputs.normal_force[i], tires.front if i < LR else tires.rear
        if fz > 0.0:
            kappa, alpha = outputs.slip_ratio[i], outputs.slip_angle[i]
            noted = events.out_of_range_time
            note_range(time, kappa, tire.KPUMIN, tire.KPUMAX, noted, SLIP_RATIO)
            note_range(time, alpha, tire.ALPMIN, tire.ALPMAX, noted, SLIP_ANGLE)
            note_range(time, fz, tire.FZMIN, tire.FZMAX, noted, NORMAL_FORCE)
            if tire.plain == 0.0:
                gamma = outputs.inclination[i]
                note_range(time, gamma, tire.CAMMIN, tire.CAMMAX, noted, INCLINATION)


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
    """Record the wheels that lifted off during a step (s) from `time` (s) on.

    step: 0 for a lift-off caused by a step of a command.
    """
    for i in range(WHEEL_COUNT):
        before = events.support[i]
        if support[i] <= 0.0 < before and math.isnan(events.lift_off_time[i]):
            events.lift_off_time[i] = crossing_time(time, step, before, support[i])
        events.support[i] = support[i]


@kernel
def note_rollover(time, step, roll_before, roll, rollover_angle, events):
    """Record the first rollover during a step (s) from `time` (s) on; angles in rad."""
    left, gone = rollover_angle - abs(roll_before), rollover_angle - abs(roll)
    if gone <= 0.0 < left and math.isnan(events.rollover_time[0]):
        events.rollover_time[0] = crossing_time(time, step, left, gone)


@kernel
def most_implausible(state, largest):
    """Index of the state that exceeds its limit most, or is not finite; -1 if all are plausible.

    A limit of nan marks a state that the model does not have.
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
    """The condition of a run at a flat state vector, divergence aside."""
    if abs(state[at.ROLL]) >= limits.stop_angle:
        return Condition.ROLLED_OVER
    if state[at.U] < limits.minimum_speed * (1 - SPEED_ROUNDING):
        return Condition.TOO_SLOW
    return Condition.RUNNING
