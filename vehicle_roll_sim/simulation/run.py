"""A run from beginning to end, without ROS: drive, sample, stop where the model stops."""

from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.model.advance import NANOSECONDS
from vehicle_roll_sim.model.events import Condition
from vehicle_roll_sim.simulation.command import Programme
from vehicle_roll_sim.simulation.history import History, row_of
from vehicle_roll_sim.simulation.simulation import Simulation, whole_steps

DEFAULT_SAMPLE = 0.01
"""s between two rows"""


def run(
    simulation: Simulation,
    programme: Programme,
    duration: float,
    *,
    sample: float = DEFAULT_SAMPLE,
    command_period: float = 0.0,
    progress: Callable[[float], None] = lambda seconds: None,
) -> History:
    """Drive from the present state for `duration` (s), a row every `sample` (s) and at the end.

    The programme is evaluated at every stage of the integration or, with `command_period` (s), at
    the beginning of each period and then held, as a node does. `progress` is told the simulated
    time (s) of every stretch. Raises InputError for times that are no multiples of the step.
    """
    step_ns = simulation.step_ns
    every = whole_steps(sample, step_ns, "sample") * step_ns
    period = (
        whole_steps(command_period, step_ns, "command period") * step_ns if command_period else 0
    )
    end = simulation.time_ns + whole_steps(duration, step_ns, "duration") * step_ns
    rows = [row_of(simulation)]
    held = None
    while simulation.time_ns < end and simulation.condition is Condition.RUNNING:
        now = simulation.time_ns
        if period and (held is None or now % period == 0):
            held = hold(programme, now / NANOSECONDS)
        until = min(_next(now, every), end, _next(now, period) if period else end)
        simulation.step(held or programme, (until - now) / NANOSECONDS)
        ended = simulation.time_ns == end or simulation.condition is not Condition.RUNNING
        if ended or simulation.time_ns % every == 0:
            rows.append(row_of(simulation))
        progress((simulation.time_ns - now) / NANOSECONDS)
    return History(rows)


def hold(programme: Programme, time: float) -> Programme:
    """The command of `programme` at `time` (s), held for ever."""
    command = programme(np.array([time]))
    return lambda times: command


def _next(now: int, interval: int) -> int:
    """The first multiple of `interval` after `now`."""
    return (now // interval + 1) * interval
