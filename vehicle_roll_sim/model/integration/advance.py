"""Integration of several steps in one call of compiled code."""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.integration.derivatives import derivatives
from vehicle_roll_sim.model.integration.events import (
    Condition,
    condition_of,
    most_implausible,
    note_lift_offs,
    note_peaks,
    note_rollover,
    without_rate,
)
from vehicle_roll_sim.model.integration.integrator import (
    BEFORE,
    K1,
    KEPT,
    TRIAL,
    along,
    copy,
    rk4_step,
)
from vehicle_roll_sim.model.kinematic.contact import note_tire_compression
from vehicle_roll_sim.model.wheel import note_turning, stop_reversed

NANOSECONDS = 1_000_000_000
"""Nanoseconds, the unit of simulated time, per second; division by it rounds correctly."""


@kernel
def advance(state, commands, steps, start_ns, step_ns, plant, outputs, events, stages):
    """Integrate up to `steps` steps; returns the number taken, the condition and the culprit.

    state: flat vector laid out as STATE, changed in place. commands: 2 * steps + 1 records, for the
    beginning, the middle and the end of each step, or a single one that is held. start_ns, step_ns:
    simulated time and step (ns). plant: vehicle, tires, options, limits and a
    zero command, in arrays of records, as are outputs and events, and the ground, an array of
    numbers (see `road.layout`). stages: work space.

    If the initial state is implausible or has a non-finite rate, no step is taken; a step that
    leads to such a state is undone. The culprit is the index of the state concerned, else -1. An
    implausible initial state is replaced by the final state of the previous call, stored in
    `stages`. At the end `outputs` correspond to the final state and the last command or, after
    divergence, which the command may have caused, to the zero command.
    """
    vehicle, tires, options, limits = plant[0][0], plant[1][0], plant[2][0], plant[3][0]
    idle, ground = plant[4][0], plant[5]
    out, seen = outputs[0], events[0]
    car = (vehicle, tires, options, out)
    stride = 0 if len(commands) == 1 else 1
    step = step_ns / NANOSECONDS
    taken, condition = 0, Condition.RUNNING
    culprit = most_implausible(state, limits.largest)
    if culprit >= 0:
        copy(stages[KEPT], state)
        return taken, Condition.DIVERGED, culprit
    note_turning(state, out)
    now = start_ns / NANOSECONDS
    derivatives(state, commands[0], vehicle, tires, options, ground, now, out, stages[K1])
    note_tire_compression(state, options, out)
    culprit = without_rate(stages[K1], limits.largest)
    if culprit < 0:
        note_lift_offs(start_ns / NANOSECONDS, 0.0, out.support, seen)
    while taken < steps and culprit < 0 and condition == Condition.RUNNING:
        time = (start_ns + taken * step_ns) / NANOSECONDS
        note_peaks(time, state, tires, out, seen)
        copy(state, stages[BEFORE])
        row = 2 * taken * stride
        after = commands[row + 2 * stride]
        rk4_step(state, commands[row + stride], after, time, step, car, ground, stages)
        stop_reversed(state, after, vehicle, out)
        culprit = diverged(state, step, stages, limits)
        if culprit < 0:
            note_turning(state, out)
            now = (start_ns + (taken + 1) * step_ns) / NANOSECONDS
            derivatives(state, after, vehicle, tires, options, ground, now, out, stages[K1])
            note_tire_compression(state, options, out)
            culprit = without_rate(stages[K1], limits.largest)
        if culprit < 0:
            taken += 1
            condition = condition_of(state, limits)
            note_lift_offs(time, step, out.support, seen)
            roll_before, roll = stages[BEFORE, at.ROLL], state[at.ROLL]
            note_rollover(time, step, roll_before, roll, limits.rollover_angle, seen)
        else:
            copy(stages[BEFORE], state)
    if culprit >= 0:
        condition = Condition.DIVERGED
        note_turning(state, out)
        now = (start_ns + taken * step_ns) / NANOSECONDS
        derivatives(state, idle, vehicle, tires, options, ground, now, out, stages[K1])
        note_tire_compression(state, options, out)
    note_peaks((start_ns + taken * step_ns) / NANOSECONDS, state, tires, out, seen)
    copy(state, stages[KEPT])
    return taken, condition, culprit


@kernel
def diverged(state, step, stages, limits):
    """Index of the most implausible state after a step (s); -1 if all are plausible.

    If one state is not finite, the others soon are not either; the index is then that of the most
    implausible state after an Euler step from the state before.
    """
    culprit = most_implausible(state, limits.largest)
    if culprit >= 0 and not math.isfinite(state[culprit]):
        along(stages[BEFORE], stages[K1], step, stages[TRIAL])
        first = most_implausible(stages[TRIAL], limits.largest)
        culprit = first if first >= 0 else culprit
    return culprit
