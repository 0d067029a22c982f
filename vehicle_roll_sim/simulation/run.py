"""A run from beginning to end, without ROS: drive, sample, stop where the model stops."""

from collections.abc import Callable

from vehicle_roll_sim.model.advance import NANOSECONDS
from vehicle_roll_sim.model.events import Condition
from vehicle_roll_sim.simulation.command import Feedback, Programme, held_command
from vehicle_roll_sim.simulation.history import History, row_of
from vehicle_roll_sim.simulation.simulation import Simulation, whole_steps

DEFAULT_SAMPLE = 0.01
"""s between two rows"""
FEEDBACK_PERIOD = 0.01
"""s between two commands that depend on the state, unless told otherwise: that of the node."""


def run(
    simulation: Simulation,
    driver: Programme | Feedback,
    duration: float,
    *,
    sample: float = DEFAULT_SAMPLE,
    command_period: float = 0.0,
    progress: Callable[[float], None] = lambda seconds: None,
) -> History:
    """Drive from the present state for `duration` (s), a row every `sample` (s) and at the end.

    A programme is evaluated at every stage of the integration or, with `command_period` (s), at
    the beginning of each period and then held, as a node does. Feedback always is, every 10 ms
    unless told otherwise. `progress` is told the simulated time (s) of every stretch. Raises
    InputError for times that are no multiples of the step.
    """
    step_ns = simulation.step_ns
    every = whole_steps(sample, step_ns, "sample") * step_ns
    if isinstance(driver, Feedback):
        command_period = command_period or FEEDBACK_PERIOD
    period = (
        whole_steps(command_period, step_ns, "command period") * step_ns if command_period else 0
    )
    end = simulation.time_ns + whole_steps(duration, step_ns, "duration") * step_ns
    rows = [row_of(simulation)]
    held = None
    while simulation.time_ns < end and simulation.condition is Condition.RUNNING:
        now = simulation.time_ns
        if period and (held is None or now % period == 0):
            held = hold(driver, now / NANOSECONDS, simulation.state)
        until = min(_next(now, every), end, _next(now, period) if period else end)
        simulation.step(held or driver, (until - now) / NANOSECONDS)
        ended = simulation.time_ns == end or simulation.condition is not Condition.RUNNING
        if ended or simulation.time_ns % every == 0:
            rows.append(row_of(simulation))
        progress((simulation.time_ns - now) / NANOSECONDS)
    return History(rows)


def hold(driver: Programme | Feedback, time: float, state=None) -> Programme:
    """The command of `driver` at `time` (s) in that state, held for ever."""
    command = held_command(driver, time, state)
    return lambda times: command


def _next(now: int, interval: int) -> int:
    """The first multiple of `interval` after `now`."""
    return (now // interval + 1) * interval
