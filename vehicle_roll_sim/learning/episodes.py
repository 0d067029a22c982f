"""Episodes that run side by side, on which both environments are based; without gymnasium."""

import inspect
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from vehicle_roll_sim.batch.fleet import Fleet
from vehicle_roll_sim.declaration import InputError, shown, unknown_name
from vehicle_roll_sim.learning.actions import Actions, check_action_names, shares_of
from vehicle_roll_sim.learning.commands import Drivers, periods_of
from vehicle_roll_sim.learning.observations import USUAL, Observer, Signals
from vehicle_roll_sim.learning.rewards import upright_progress
from vehicle_roll_sim.learning.scenario import Scenario
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import COMMAND, WHEEL_COUNT
from vehicle_roll_sim.runs.metrics import wheel_lift
from vehicle_roll_sim.runs.run import HELD_PERIOD
from vehicle_roll_sim.runs.run_metrics import metrics_of_series
from vehicle_roll_sim.simulation.limits import whole_steps

Reward = Callable[[Signals, np.ndarray, np.ndarray], np.ndarray]
FACTORS = {"manoeuvre.speed": {"distribution": "uniform", "lowest": 14.0, "highest": 20.0}}
"""What is drawn for each episode by default."""
STEP = 0.0025
"""s: integration step."""
TIME, LOADS, LIFTS, ROW_SIZE = 0, slice(1, 5), slice(5, 9), 9
"""Columns of the rows, one for each period, from which the metrics are computed."""


class Episodes:
    """Episodes of one scenario at the places of a fleet, one action for each in every period.

    count: number of places. manoeuvre: a name of the catalogue, a list of names from which one is
    drawn for each episode, or None for straight ahead. vehicle: a Vehicle, the name of a shipped
    one, or a vehicle file. actions, observations: names of ACTIONS and OBSERVATIONS. factors,
    fixed, correlations, model: as in a study (docs/studies.md). period: time for which an action is
    held (s). step: integration step (s). stop_roll: roll angle that counts as a rollover (deg).
    limits: values of CommandLimits, for which an action of 1 stands, by name. reward: a function
    with the arguments of `upright_progress`. workers: number of threads.

    Raises InputError. Attributes: `actions` and `observer`, which know spaces and names;
    `has_ended`, `rolled_over`, of each place, shape (count,).
    """

    def __init__(
        self,
        count: int,
        manoeuvre: str | Sequence[str] | None = "nhtsa_fishhook",
        vehicle="reference",
        *,
        actions: Sequence[str] = ("brake_torque",),
        observations: Sequence[str] = USUAL,
        factors: Mapping = FACTORS,
        fixed: Mapping | None = None,
        correlations: Sequence | None = None,
        model: str | None = None,
        period: float = HELD_PERIOD,
        step: float = STEP,
        stop_roll: float | None = None,
        limits: Mapping[str, float] | None = None,
        reward: Reward = upright_progress,
        workers: int | None = None,
        **unknown,
    ):
        if unknown:
            known = list(inspect.signature(Episodes).parameters)[1:-1]
            raise unknown_name(next(iter(unknown)), known, "argument")
        self.actions = Actions(actions, {} if limits is None else limits)
        check_action_names(self.actions.names, manoeuvre is not None)
        self.observer = Observer(observations)
        about = {"vehicle": vehicle, "model": model, "fixed": fixed, "factors": factors}
        about |= {"correlations": correlations, "step": step, "stop_roll": stop_roll}
        self._scenario = Scenario(manoeuvre, **about)
        step_ns = round(self._scenario.step * NANOSECONDS)
        self._period_ns = whole_steps(period, step_ns, "period") * step_ns
        if not callable(reward):
            raise InputError("reward", reward, "a function, see docs/learning.md")
        self._reward, self._fleet = reward, Fleet(count, step_ns, workers)
        self._drivers = Drivers(count, self._period_ns)
        self._ends, self._counts = np.zeros((2, count), np.int64)
        self._before = np.zeros(count, COMMAND)
        self._shares = {name: np.zeros((count, WHEEL_COUNT)) for name in ("brake", "drive_torque")}
        self._rows = np.zeros((count, 1, ROW_SIZE))
        self.has_ended = np.ones(count, bool)
        self.rolled_over = np.zeros(count, bool)
        self._check_observations()

    def _check_observations(self) -> None:
        """Raise InputError for observations that the model does not have."""
        self.begin(0, np.random.default_rng(0), {})
        unknown = np.isnan(self.observe()[0])
        self.has_ended[0] = True
        if unknown.any():
            name = self.observer.elements[int(np.argmax(unknown))]
            raise InputError("observations", name, "a quantity that the model, or a sensor, has")

    def begin(self, i: int, generator: np.random.Generator, chosen: Mapping) -> dict:
        """Begin an episode at a place; returns its info. Raises InputError.

        chosen: values of factors that are not drawn, by their names.
        """
        start = self._scenario.begin(generator, chosen)
        self._fleet.place(i, start.simulation)
        periods = periods_of(start.manoeuvre.duration, self._period_ns)
        self._drivers.begin(i, start.manoeuvre, periods)
        self._ends[i] = round(start.manoeuvre.duration * NANOSECONDS)
        for name, shares in shares_of(start.simulation.vehicle).items():
            self._shares[name][i] = shares
        self._before[i] = np.zeros(1, COMMAND)[0]
        self.has_ended[i] = self.rolled_over[i] = False
        if periods >= self._rows.shape[1]:
            missing = periods + 1 - self._rows.shape[1]
            self._rows = np.pad(self._rows, ((0, 0), (0, missing), (0, 0)))
        self._counts[i] = 0
        self._note_rows(np.array([i]))
        return {"time": 0.0, "drawn": start.drawn}

    def step(self, given, going: np.ndarray) -> np.ndarray:
        """Advance by one period the episodes that are `going`; returns all rewards, shape (n,).

        given: an action for each place, shape (n, k). Rewards of others are 0. Raises InputError.
        """
        actions = self.actions.checked(given, len(self._fleet))
        commands = self._drivers.commands(self._fleet, going)
        about = (self._before, self._shares, self._period_ns)
        self.actions.add_to(commands, actions, *about)
        self._before = commands
        now = self._fleet.times_ns.copy()
        until = np.minimum(now + self._period_ns, self._ends)
        self._fleet.step(commands, np.where(going, (until - now) // self._fleet.step_ns, 0))
        has_moved = self._fleet.times_ns > now
        self._note_rows(np.flatnonzero(has_moved))
        stopped = ~self._fleet.runs
        self.rolled_over = going & (self._fleet.conditions == Condition.ROLLED_OVER)
        self.has_ended |= going & (stopped | (self._fleet.times_ns >= self._ends))
        return np.where(going, self._rewards(actions), 0.0)

    def _rewards(self, actions: np.ndarray) -> np.ndarray:
        given = self._reward(Signals(self._fleet), actions, self.rolled_over)
        allowed = f"an array of {len(self._fleet)} numbers"
        if np.shape(given) != (len(self._fleet),):
            raise InputError("reward", "", allowed, f"returned shape {np.shape(given)}")
        try:
            return np.asarray(given, np.float64)
        except (TypeError, ValueError):
            raise InputError("reward", "", allowed, f"returned {shown(given)}") from None

    def _note_rows(self, places: np.ndarray) -> None:
        """Keep a row for the metrics of each place that has moved."""
        rows = np.empty((len(places), ROW_SIZE))
        rows[:, TIME] = self._fleet.times[places]
        rows[:, LOADS] = self._fleet.outputs["normal_force"][places]
        rows[:, LIFTS] = wheel_lift(self._fleet.states["tire_compression"][places])
        self._rows[places, self._counts[places]] = rows
        self._counts[places] += 1

    def observe(self) -> np.ndarray:
        """The observations of all places, shape (n, m)."""
        return self.observer.observe(self._fleet)

    @property
    def times(self) -> np.ndarray:
        """Simulated time of the episodes (s), shape (n,)."""
        return self._fleet.times

    def final_info(self, i: int) -> dict:
        """The condition and the metrics of an episode that has ended."""
        rows = self._rows[i, : self._counts[i]]
        series = (rows[:, TIME], rows[:, LOADS], rows[:, LIFTS])
        metrics = metrics_of_series(*series, self._fleet.events[i], float(self._fleet.times[i]))
        condition = Condition(self._fleet.conditions[i])
        return {"condition": condition.name, "metrics": metrics}

    def close(self) -> None:
        """End the threads."""
        self._fleet.close()
