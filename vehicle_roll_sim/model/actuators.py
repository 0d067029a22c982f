"""Actuators: from the commands to the quantities that act on the vehicle, step by step.

A value passes through resolution and range, dead time, rate limit, lag, and the range again, which
an underdamped lag may overshoot. The command is taken as linear between the instants at which it is
known, the beginning, the middle and the end of a step; the lag is exact for it.

A rate limiter is evaluated at these instants. For a speed hold see `note_demand`.
"""

from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.layout import record_dtype
from vehicle_roll_sim.model.records import COMMAND, LR, WHEEL_COUNT


def _place(name: str) -> int:
    """Position of a field of COMMAND among its numbers."""
    return COMMAND.fields[name][1] // 8


WHEEL_TORQUE, BRAKE_TORQUE, NORMAL_FORCE = map(
    _place, ("wheel_torque", "brake_torque", "normal_force")
)
CHANNELS = HOLD_GAIN = _place("speed_hold_gain")
"""Number of values that have an actuator; the others follow them in a command."""
HOLD_TARGET, WIND = _place("speed_hold_target"), _place("wind")
ROAD_HEIGHT, ROAD_FRICTION = _place("road_height"), _place("road_friction_change")
COMMAND_SIZE = COMMAND.itemsize // 8
INSTANTS = 3
"""Beginning, middle and end of a step."""
BEGIN, MIDDLE, END, LIMITED, LAGGED, LAG_RATE, QUEUE = range(7)
"""Rows of the memory of the actuators, each a COMMAND: what acts in the present step at its three
instants; output of the rate limiters; state of the lags and its rate (1/s); and the first row of
the queue, INSTANTS rows of demands for each step."""

_PER_CHANNEL = ("resolution", "lowest", "highest", "most_per_half_step")
_OF_LAG = (
    *("value_by_value", "value_by_rate", "value_by_ramp"),
    *("rate_by_value", "rate_by_rate", "rate_by_ramp"),
)
ACTUATORS = record_dtype(
    *("present", "takes_speed_hold", "slots"),
    *((name, CHANNELS) for name in ("delay", "has_lag", *_PER_CHANNEL, *_OF_LAG)),
)
"""The actuators, discretised for half an integration step.

present, has_lag: 1 or 0. takes_speed_hold: 1 if the torque of a speed hold passes through them.
slots: steps in the queue. delay: dead time in steps. lowest, highest: the range; inf for none, as
is most_per_half_step, the largest change. value_by_value ...: the matrix of a lag, see
`follow`.
"""


@kernel
def note_demand(asked, speed, actuators, row):
    """Write what is asked at one instant to a row of the queue, in steps of the resolution and
    within the range.

    If drive torques have an actuator, the torque of the speed hold passes through it: with the
    speed (m/s) at the beginning of the step.
    """
    row[0], row[1] = asked.steering, asked.rear_steering
    for i in range(WHEEL_COUNT):
        row[WHEEL_TORQUE + i] = asked.wheel_torque[i]
        row[BRAKE_TORQUE + i] = asked.brake_torque[i]
        row[NORMAL_FORCE + i] = asked.normal_force[i]
        row[ROAD_HEIGHT + i] = asked.road_height[i]
        row[ROAD_FRICTION + i] = asked.road_friction_change[i]
    row[HOLD_GAIN], row[HOLD_TARGET] = asked.speed_hold_gain, asked.speed_hold_target
    for i in range(ROAD_HEIGHT - WIND):
        row[WIND + i] = asked.wind[i]
    if actuators.takes_speed_hold > 0.0:
        torque = asked.speed_hold_gain * (asked.speed_hold_target - speed)
        for i in range(LR, WHEEL_COUNT):
            row[WHEEL_TORQUE + i] += torque
        row[HOLD_GAIN], row[HOLD_TARGET] = 0.0, 0.0
    for i in range(CHANNELS):
        quantised = in_steps_of(actuators.resolution[i], row[i])
        row[i] = within(actuators.lowest[i], actuators.highest[i], quantised)


@kernel
def in_steps_of(resolution, value):
    """The nearest multiple of the resolution, that above if two are; 0 leaves the value alone."""
    if abs(value) < 2.0**52 * resolution:
        return math.floor(value / resolution + 0.5) * resolution
    return value


@kernel
def within(lowest, highest, value):
    if value < lowest:
        return lowest
    return highest if value > highest else value


@kernel
def follow(channel, actuators, beginning, end, value, rate):
    """Value and rate of a lag after half a step in which its input has been linear.

    x, v after x0, v0, with an input from a to b: x = b + A (x0 - a) + B v0 + C (b - a),
    v = D (x0 - a) + F v0 + G (b - a).
    """
    apart, ramp = value - beginning, end - beginning
    of_value, of_rate = actuators.value_by_value[channel], actuators.value_by_rate[channel]
    after = end + of_value * apart + of_rate * rate + actuators.value_by_ramp[channel] * ramp
    of_value, of_rate = actuators.rate_by_value[channel], actuators.rate_by_rate[channel]
    return after, of_value * apart + of_rate * rate + actuators.rate_by_ramp[channel] * ramp


@kernel
def act(step, moves, actuators, memory):
    """Write what acts in a step to the rows BEGIN, MIDDLE and END.

    step: its number since the reset. Its demands must be in the queue. moves: whether the step is
    made; if not, only BEGIN is of use and the state of the actuators stays. memory: shape
    (rows, COMMAND_SIZE).
    """
    slots = int(actuators.slots)
    now = QUEUE + INSTANTS * (step % slots)
    for instant in range(INSTANTS):
        for i in range(CHANNELS, COMMAND_SIZE):
            memory[instant, i] = memory[now + instant, i]
    for i in range(CHANNELS):
        asked = QUEUE + INSTANTS * ((step - int(actuators.delay[i])) % slots)
        lowest, highest = actuators.lowest[i], actuators.highest[i]
        most, has_lag = actuators.most_per_half_step[i], actuators.has_lag[i] > 0.0
        value, rate, limited = memory[LAGGED, i], memory[LAG_RATE, i], memory[LIMITED, i]
        target = memory[asked, i] if math.isinf(most) else limited
        memory[BEGIN, i] = within(lowest, highest, value if has_lag else target)
        for instant in range(MIDDLE, INSTANTS):
            before, target = target, memory[asked + instant, i]
            target = within(before - most, before + most, target)
            if has_lag:
                value, rate = follow(i, actuators, before, target, value, rate)
            memory[instant, i] = within(lowest, highest, value if has_lag else target)
        if moves:
            memory[LAGGED, i], memory[LAG_RATE, i], memory[LIMITED, i] = value, rate, target
