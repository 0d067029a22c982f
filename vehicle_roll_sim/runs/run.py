"""A run from beginning to end without ROS: drive, sample, and stop when the model stops."""

import bisect
from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np

from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import COMMAND, LR
from vehicle_roll_sim.runs.columns import further_of, measured_names, row_of
from vehicle_roll_sim.runs.derived_signals import LIFT_PLACES, lifts_on_road
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Command, Feedback, Programme, command_at
from vehicle_roll_sim.simulation.limits import whole_steps
from vehicle_roll_sim.simulation.simulation import Simulation

DEFAULT_SAMPLE = 0.01
"""s between rows of the history."""
HELD_PERIOD = 0.01
"""s: default period for which commands are held, that of the node."""


class Observer(Protocol):
    """Observer of a run, called when a node would publish or apply something."""

    def on_set(self) -> None:
        """Called at the beginning of the run and at the end of each period."""

    def on_command(self, command: Command) -> None:
        """Called with the command that is applied in the next period."""


def run(
    simulation: Simulation,
    driver: Programme | Feedback,
    duration: float,
    *,
    sample: float = DEFAULT_SAMPLE,
    command_period: float = 0.0,
    observer: Observer | None = None,
    progress: Callable[[float], None] = lambda seconds: None,
) -> History:
    """Drive from the present state for `duration` (s); a row every `sample` (s) and at the end.

    A Programme is evaluated at every stage of the integration or, with `command_period` (s), at the
    beginning of each period and then held, as a node does. The steps in its `steps_at` are exact at
    multiples of the integration step; the row at the time of a step shows the commands before it.
    The commands of a Feedback, and all commands if there is a observer, are held for
    `command_period`, by default 10 ms. `progress` is called with each increment of simulated time
    (s). Raises InputError for times that are not multiples of the integration step.
    """
    step_ns = simulation.step_ns
    every = whole_steps(sample, step_ns, "sample") * step_ns
    if isinstance(driver, Feedback) or observer:
        command_period = command_period or HELD_PERIOD
    period = (
        whole_steps(command_period, step_ns, "command period") * step_ns if command_period else 0
    )
    end = simulation.time_ns + whole_steps(duration, step_ns, "duration") * step_ns
    steps_at = [] if period else in_whole_steps(getattr(driver, "steps_at", ()), step_ns)
    rows, held = [row_of(simulation)], None
    further = [further_of(simulation)]
    places = LIFT_PLACES if simulation.road.features else LIFT_PLACES[:0]
    on_road = [simulation.output_vector[places]]
    readings = [simulation.sensors.readings()]
    driven = [_driven(simulation, Command() if period else None)]
    if observer:
        observer.on_set()
    while simulation.time_ns < end and simulation.condition is Condition.RUNNING:
        now = simulation.time_ns
        if period and (held is None or now % period == 0):
            held = command_at(driver, now / NANOSECONDS, simulation.state)
            if observer:
                observer.on_command(held)
        until = min(_next(now, every), end, _next(now, period) if period else end)
        if (following := bisect.bisect(steps_at, now)) < len(steps_at):
            until = min(until, steps_at[following])
        simulation.step(held or driver, (until - now) / NANOSECONDS)
        ended = simulation.time_ns == end or simulation.condition is not Condition.RUNNING
        has_moved = simulation.time_ns > now  # unless its first step diverged
        if has_moved and (ended or simulation.time_ns % every == 0):
            rows.append(row_of(simulation))
            further.append(further_of(simulation))
            on_road.append(simulation.output_vector[places])
            readings.append(simulation.sensors.readings())
            driven.append(_driven(simulation, held))
        if observer and (ended or simulation.time_ns % period == 0):
            observer.on_set()
        progress((simulation.time_ns - now) / NANOSECONDS)
    history = History(rows)
    history.add_further(np.array(further), simulation.options)
    if simulation.road.features:
        history.lifts = lifts_on_road(np.array(on_road), simulation)
    history.measured, history.measured_names = np.array(readings), measured_names(simulation)
    if driven[0] is None:
        records = records_by_time(history, driver)
    else:
        records = np.concatenate([each.view(float) for each in driven]).view(COMMAND)
        if simulation.has_actuators:
            add_hold(records, history)
    add_commands(history, records, simulation.feels_wind)
    return history


def _driven(simulation: Simulation, held: Command | None) -> np.ndarray | None:
    """What has driven a simulation to the present: one COMMAND record, None if not known here."""
    if simulation.has_actuators:
        return simulation.actuation.records()
    return held.records() if held else None


def records_by_time(history: History, programme: Programme) -> np.ndarray:
    """COMMAND records of a programme at the rows, with its speed hold as a torque."""
    records = np.broadcast_to(programme(history["time"]), len(history.rows)).copy()
    add_hold(records, history)
    return records


def add_hold(records: np.ndarray, history: History) -> None:
    """Add the torque of the speed hold to COMMAND records, one for each row."""
    hold = records["speed_hold_gain"] * (records["speed_hold_target"] - history["u"])
    records["wheel_torque"][:, LR:] += hold[:, np.newaxis]


def add_commands(history: History, records: np.ndarray, feels_wind: bool) -> None:
    """Add commands to a history: COMMAND records without a speed hold, one for each row."""
    others = (records["brake_torque"], records["normal_force"])
    torques = (records["wheel_torque"], *others)
    history.commands = np.column_stack((records["rear_steering"], *torques))
    if feels_wind:
        history.wind = records["wind"].copy()


def in_whole_steps(times: Sequence[float], step_ns: int) -> list[int]:
    """Those of `times` (s) that are multiples of the integration step, in ns."""
    nanoseconds = [round(time * NANOSECONDS) for time in times]
    return [time for time in nanoseconds if time % step_ns == 0]


def _next(now: int, interval: int) -> int:
    """The next multiple of `interval` after `now`."""
    return (now // interval + 1) * interval
