"""A run in one call of compiled code: commands, integration and rows, period by period."""

import functools

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.actuators import END as LAST_OF_STEP
from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.integration.actuated import advance_actuated
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import LR, WHEEL_COUNT

NOW, END, LAST, STEP, SAMPLE, PERIOD = range(6)
"""Elements of the clock (ns): present time, time to stop at, end of the whole run, integration
step, time between rows, and time for which commands are held, 0 if they are not."""
SIDE, LEVEL, SINCE, HAS_RISEN = range(4)
"""Elements of the watch of the roll rate: deg per rad, with the sign of the side to which it
counts as positive, 0 if it is not watched; level (deg/s); time from which a drop counts (s); and
whether the rate has been above the level."""
CLOCK_SIZE, WATCH_SIZE = 6, 4

unlocked = functools.partial(kernel, nogil=True)
"""A kernel during which other Python threads run."""


@unlocked
def drive(address, parts, commands, held, clock, watch, places, rows, driven):
    """Drive until a time, until the run must stop, or until the watched roll rate has dropped.

    address: of `advance`. parts: state, plant, outputs, outputs as a flat vector, events, work
    space, and actuators as `advance_actuated` takes them. commands: COMMAND records, one for each
    period, or for the beginning, the middle and the end of each step. held: work space, one of
    them. clock, watch: see above; changed in place. places: indices of the outputs in a row. rows,
    driven: rows of the history, and the command held or, with actuators, acting at each, from the
    present time on.

    Returns the number of rows, the condition, the culprit as from `advance`, and whether the
    watch has gone off; the command of the period that begins then has not been applied.
    """
    state, plant, outputs, output_vector, events, stages, actuation = parts
    has_actuators = actuation[0][0].present > 0.0
    begin, end = clock[NOW], clock[END]
    step, sample, period = clock[STEP], clock[SAMPLE], clock[PERIOD]
    now, count, condition, culprit = begin, 0, Condition.RUNNING, -1
    while now < end and condition == Condition.RUNNING:
        until = min(following(now, sample), end)
        if period > 0:
            if now == begin or now % period == 0:
                if has_dropped(state[at.ROLL_RATE], now / NANOSECONDS, watch):
                    clock[NOW] = now
                    return count, condition, culprit, True
                hold(commands[now // period - begin // period], state[at.U], held[0])
            until = min(until, following(now, period))
            given = held[0:1]
        else:
            first = 2 * ((now - begin) // step)
            given = commands[first : first + 2 * ((until - now) // step) + 1]
        steps = (until - now) // step
        arguments = (state, given, steps, now, step, plant, outputs, events, stages)
        taken, condition, culprit = advance_actuated(address, arguments, actuation)
        now += taken * step
        is_row = condition != Condition.RUNNING or now == clock[LAST] or now % sample == 0
        if taken > 0 and is_row:
            write_row(now, state, output_vector, places, rows[count])
            driven[count] = actuation[1][LAST_OF_STEP] if has_actuators else held[0]
            count += 1
    clock[NOW] = now
    return count, condition, culprit, False


@kernel
def following(now, interval):
    """The next multiple of `interval` after `now`."""
    return (now // interval + 1) * interval


@kernel
def hold(asked, speed, held):
    """Write a command to `held`, with its speed hold replaced by the torque at this speed (m/s).

    The change of friction is rounded as in a Command, which has the friction itself.
    """
    held.steering, held.rear_steering = asked.steering, asked.rear_steering
    torque = asked.speed_hold_gain * (asked.speed_hold_target - speed)
    for i in range(WHEEL_COUNT):
        driving = asked.wheel_torque[i]
        held.wheel_torque[i] = driving + torque if i >= LR else driving
        held.brake_torque[i] = asked.brake_torque[i]
        held.normal_force[i] = asked.normal_force[i]
        held.road_height[i] = asked.road_height[i]
        held.road_friction_change[i] = (1.0 + asked.road_friction_change[i]) - 1.0
    for i in range(len(held.wind)):
        held.wind[i] = asked.wind[i]


@kernel
def has_dropped(roll_rate, time, watch):
    """Whether the roll rate (rad/s) has been above the watched level and, at `time` (s), no longer
    is. That it has been above counts from the beginning."""
    if watch[SIDE] == 0.0:
        return False
    is_above = roll_rate * watch[SIDE] > watch[LEVEL]
    if is_above:
        watch[HAS_RISEN] = 1.0
    return watch[HAS_RISEN] > 0.0 and not is_above and time >= watch[SINCE]


@kernel
def write_row(now, state, output_vector, places, row):
    """Write time (s), states and outputs of a row of the history."""
    row[0] = now / NANOSECONDS
    for i in range(at.MODEL_STATE_SIZE):
        row[1 + i] = state[i]
    for i in range(len(places)):
        row[1 + at.MODEL_STATE_SIZE + i] = output_vector[places[i]]
