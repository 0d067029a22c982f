"""Simulates a recorded run again from its applied commands, and compares the two."""

import dataclasses
import itertools
import math

import numpy as np

from vehicle_roll_sim.bags.reading import RecordedRun
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.messages.run_messages import demand_in, road_in, wind_in
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.simulation.command import STILL_AIR, Command
from vehicle_roll_sim.simulation.simulation import Simulation

LONGEST_PERIOD = 1.5
"""Publish periods between two sets; if it is longer, sets are missing between them."""


@dataclasses.dataclass(frozen=True)
class Replay:
    """How a replayed run compares with its recording.

    end: simulated time (s) up to which they were compared, after `periods` periods. missing_from:
    time (s) at which the recording has a gap, else nan. relative: the largest difference of any
    state, as a fraction of that state's peak; difference, name and time: that difference in the
    state's unit, the state, and when it occurs (s). What sensors measured is compared like states.
    """

    end: float
    periods: int
    missing_from: float
    difference: float
    relative: float
    name: str
    time: float

    @property
    def is_exact(self) -> bool:
        """Whether every compared state and measurement was reproduced bit for bit."""
        return self.difference == 0.0

    @property
    def is_complete(self) -> bool:
        """Whether the whole recording was compared, at least one period."""
        return self.periods > 0 and math.isnan(self.missing_from)


def replay(run: RecordedRun, simulation: Simulation, period: float | None = None) -> Replay:
    """Drive `simulation` as the recorded vehicle was driven, from its reset on.

    period: publish period (s), None for the median in the recording. Raises InputError if the
    recording does not begin with the state of this vehicle at a reset.
    """
    recorded = _recorded_states(run, simulation)
    _reset_as(recorded[0], simulation)
    own, missing_from = [_state(simulation)], np.nan
    measured = [simulation.sensors.readings()]
    if period is None:
        period = float(np.median(np.diff(np.unique(recorded[:, 0])))) if len(recorded) > 1 else 0.0
    for before, now in itertools.pairwise(recorded[:, 0].tolist()):
        if now not in run.commands or now - before > LONGEST_PERIOD * period:
            missing_from = before
            break
        steps = round((now - before) * NANOSECONDS / simulation.step_ns)
        if steps:
            command = _command(run.commands[now])
            simulation.step(command, steps * simulation.step_ns / NANOSECONDS)
        own.append(_state(simulation))
        measured.append(simulation.sensors.readings())
    found = np.hstack((own, measured))
    recorded = np.hstack((recorded[: len(own)], _measured(run, recorded[: len(own), 0], measured)))
    names = (*simulation.state_names, *simulation.sensors.labels)
    return _compared(recorded, found, names, missing_from)


def _measured(run: RecordedRun, times: np.ndarray, own: list[np.ndarray]) -> np.ndarray:
    """What was measured in the sets at these times (s); where no message has it, what is expected.

    Raises InputError for measurements of other sensors.
    """
    found = [run.measurements.get(time, own[k]) for k, time in enumerate(times.tolist())]
    size = len(own[0])
    if any(len(each) != size for each in found):
        problem = "values of other sensors"
        raise InputError("BAG: measurements", "", f"{size} values of those of the vehicle", problem)
    return np.array(found)


def _recorded_states(run: RecordedRun, simulation: Simulation) -> np.ndarray:
    """One row for each recorded set: the time and the states of the model; raises InputError."""
    labels = ["time", *simulation.state_names]
    found = list(run.states[0])
    if found != labels:
        model = simulation.options.model
        allowed = f"those of model {model}, {len(labels)} with the time"
        raise InputError("BAG: state", "", allowed, f"other states, {len(found)} with the time")
    return np.array([list(state.values()) for state in run.states])


def _reset_as(first: np.ndarray, simulation: Simulation) -> None:
    """Reset to the speed of the first recorded state; raises InputError if states differ."""
    simulation.reset(float(first[1 + simulation.state_names.index("u")]))
    own = _state(simulation)
    differs = ~((first == own) | (np.isnan(first) & np.isnan(own)))
    if differs.any():
        name = ("time", *simulation.state_names)[int(np.argmax(differs))]
        was, is_now = (float(state[np.argmax(differs)]) for state in (first, own))
        allowed = f"{is_now:.9g} as in the simulated vehicle: a different vehicle was recorded"
        raise InputError(f"BAG: {name} at the reset", was, allowed)


def _state(simulation: Simulation) -> np.ndarray:
    return np.array([simulation.time, *simulation.model_state])


def _command(values: np.ndarray) -> Command:
    """The command that was given, from the values of an `applied_command`."""
    steering, rear_steering, *rest = map(float, demand_in(values))
    torque, brake, force = (rest[k * WHEEL_COUNT : (k + 1) * WHEEL_COUNT] for k in range(3))
    wind = tuple(map(float, wind_in(values))) or STILL_AIR
    road = tuple(map(float, road_in(values)))
    of_road = {}
    if road:
        of_road = {"road_height": road[:WHEEL_COUNT], "road_friction": road[WHEEL_COUNT:]}
    return Command(steering, rear_steering, torque, brake, force, wind=wind, **of_road)


def _compared(
    recorded: np.ndarray, own: np.ndarray, names: tuple[str, ...], missing_from: float
) -> Replay:
    apart = np.abs(own - recorded)
    apart[np.isnan(own) & np.isnan(recorded)] = 0.0
    apart[np.isnan(apart)] = np.inf
    peaks = np.nanmax(np.abs(recorded), axis=0, initial=0.0)
    relative = apart / np.where(peaks > 0.0, peaks, 1.0)
    row, column = np.unravel_index(np.argmax(relative), relative.shape)
    return Replay(
        end=float(recorded[-1, 0]),
        periods=len(recorded) - 1,
        missing_from=missing_from,
        difference=float(apart[row, column]),
        relative=float(relative[row, column]),
        name=("time", *names)[column],
        time=float(recorded[row, 0]),
    )
