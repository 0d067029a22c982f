"""A run whose whole loop is compiled: the same bits as `runs.run.run`, without its time in Python.

Other Python threads run meanwhile, so that several runs use several processors.
"""

import bisect
import math

import numpy as np

from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.drive import (
    CLOCK_SIZE,
    END,
    HAS_RISEN,
    LAST,
    LEVEL,
    NOW,
    PERIOD,
    SAMPLE,
    SIDE,
    SINCE,
    WATCH_SIZE,
)
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.runs.columns import COLUMNS, FURTHER_PLACES, OUTPUT_PLACES, further_of, row_of
from vehicle_roll_sim.runs.derived_signals import LIFT_PLACES, lifts_on_road
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import (
    DEFAULT_SAMPLE,
    HELD_PERIOD,
    add_commands,
    add_hold,
    in_whole_steps,
    records_by_time,
    run,
)
from vehicle_roll_sim.simulation.command import Programme, records_of
from vehicle_roll_sim.simulation.driving import drive_on
from vehicle_roll_sim.simulation.limits import whole_steps
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.simulation.timetable import DEGREES, Timetable

LONGEST_BLOCK = 20_000
"""Steps whose commands are in memory at once: 5 MB."""
WRITABLE = ("C_CONTIGUOUS", "WRITEABLE")
"""The one form of an array that is compiled."""
PLACES = np.concatenate((OUTPUT_PLACES, FURTHER_PLACES))
"""Indices of the outputs in a row, those that not every model has last; on a road with features
LIFT_PLACES follow."""


def compiled_run(
    simulation: Simulation,
    driver: Programme | Timetable,
    duration: float,
    *,
    sample: float = DEFAULT_SAMPLE,
    with_commands: bool = True,
) -> History:
    """Drive from the present state for `duration` (s); a row every `sample` (s) and at the end.

    Arguments and result as for `run`, without command period and observer. A Programme must return
    the same commands for a time whatever the other times it is called with; it is called with
    thousands of them. with_commands: also find the commands of the rows. A vehicle with sensors,
    which take samples on the way, is left to `run`. Raises InputError for times that are not
    multiples of the integration step.
    """
    if simulation.has_sensors:
        return run(simulation, driver, duration, sample=sample)
    loop = _Loop(simulation, driver, duration, sample)
    loop.drive()
    history = loop.history()
    if with_commands:
        if simulation.has_actuators or isinstance(driver, Timetable):
            records = loop.driven[: loop.count]
        else:
            records = records_by_time(history, driver)
        if simulation.has_actuators:
            add_hold(records, history)
        add_commands(history, records, simulation.feels_wind)
    return history


class _Loop:
    """The memory of one run, and its calls of compiled code."""

    def __init__(
        self, simulation: Simulation, driver: Programme | Timetable, duration: float, sample: float
    ):
        step = simulation.step_ns
        self.simulation, self.driver, self.now = simulation, driver, simulation.time_ns
        self.sample = whole_steps(sample, step, "sample") * step
        self.period = 0
        if isinstance(driver, Timetable):
            self.period = whole_steps(HELD_PERIOD, step, "command period") * step
        self.end = self.now + whole_steps(duration, step, "duration") * step
        self.steps_at = in_whole_steps(getattr(driver, "steps_at", ()), step)
        most = (self.end - self.now) // self.sample + 3
        on_road = LIFT_PLACES if simulation.road.features else LIFT_PLACES[:0]
        self.places = np.concatenate((PLACES, on_road))
        self.rows = np.empty((most, len(COLUMNS) + len(FURTHER_PLACES) + len(on_road)))
        further = (further_of(simulation), simulation.output_vector[on_road])
        self.rows[0] = np.concatenate((row_of(simulation), *further))
        self.driven, self.held = np.zeros(most, COMMAND), np.zeros(1, COMMAND)
        if simulation.has_actuators:
            self.driven[0] = simulation.actuation.records()[0]
        self.count = 1

    def drive(self) -> None:
        """Drive to the end, or until the run must stop."""
        while self.now < self.end and self.simulation.condition is Condition.RUNNING:
            until = self._end_of_block()
            commands, watch = self._commands(until), self._watch()
            clock = np.zeros(CLOCK_SIZE, np.int64)
            clock[[NOW, END, LAST]] = self.now, until, self.end
            clock[[SAMPLE, PERIOD]] = self.sample, self.period
            rows, driven = self.rows[self.count :], self.driven[self.count :]
            count, has_dropped = drive_on(
                self.simulation, commands, self.held, clock, watch, self.places, rows, driven
            )
            self.count, self.now = self.count + count, self.simulation.time_ns
            self._heed(watch, has_dropped)

    def _end_of_block(self) -> int:
        """The time (ns) up to which commands are found at once, a multiple of sample and period,
        unless a step of the commands or the end comes before."""
        unit = math.lcm(self.sample, self.period or self.sample)
        length = unit * max(1, LONGEST_BLOCK * self.simulation.step_ns // unit)
        following = bisect.bisect(self.steps_at, self.now)
        return min(
            (self.now // length + 1) * length,
            self.end,
            *self.steps_at[following : following + 1],
        )

    def _commands(self, until: int) -> np.ndarray:
        """COMMAND records of each period until a time (ns), or of each stage of the integration."""
        if not self.period:
            steps = (until - self.now) // self.simulation.step_ns
            times = self.simulation.stage_times(steps)
            records = records_of(self.driver, lambda: times, *self.simulation.takes)
            records = records if len(records) == len(times) else np.repeat(records, len(times))
            return np.require(records, requirements=WRITABLE)
        beginnings = np.arange(self.now // self.period, -(-until // self.period)) * self.period
        beginnings[0] = self.now
        at = beginnings / NANOSECONDS
        records = records_of(self.driver.commands, lambda: at, *self.simulation.takes)
        return np.require(records, requirements=WRITABLE)

    def _watch(self) -> np.ndarray:
        """What the compiled loop watches of the roll rate; zeros for nothing."""
        watch, driver = np.zeros(WATCH_SIZE), self.driver
        if self.period and driver.reversal == math.inf:
            watch[[SIDE, LEVEL, SINCE]] = driver.side * DEGREES, driver.level, driver.since
            watch[HAS_RISEN] = driver.has_risen
        return watch

    def _heed(self, watch: np.ndarray, has_dropped: bool) -> None:
        """Tell the driver what has been seen of the roll rate."""
        if watch[SIDE]:
            self.driver.has_risen = bool(watch[HAS_RISEN])
        if has_dropped:
            self.driver.reverse(self.now / NANOSECONDS, self.simulation.state.roll_rate)

    def history(self) -> History:
        """The rows so far, without commands."""
        ends = (len(COLUMNS), len(COLUMNS) + len(FURTHER_PLACES))
        rows, further, outputs = np.split(self.rows[: self.count], ends, axis=1)
        history = History(rows)
        history.add_further(further, self.simulation.options)
        history.lifts = lifts_on_road(outputs, self.simulation) if outputs.size else None
        return history
