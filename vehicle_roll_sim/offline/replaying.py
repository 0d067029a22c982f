"""Replay: recorded runs are simulated again with the recorded commands."""

import dataclasses
from collections.abc import Iterator
from pathlib import Path

from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.input_errors import InputError, given
from vehicle_roll_sim.offline.tables import path_of
from vehicle_roll_sim.simulation.description import Described, described, difference
from vehicle_roll_sim.simulation.simulation import Simulation

FIELD = "BAG"


@dataclasses.dataclass(frozen=True)
class ReplayResult:
    """The result of replaying one recorded run.

    begin: simulated time of the first recorded state (s). recorded: the simulation described in the
    bag, with version and machine; None if the bag has no description. replay: end, periods,
    difference, is_exact, is_complete, ... (bags.replay.Replay); None for a run that was not
    recorded from its reset on.
    """

    begin: float
    recorded: Described | None
    replay: object | None

    @property
    def is_reproduced(self) -> bool:
        """Whether the whole run was reproduced bit for bit."""
        return self.replay is not None and self.replay.is_exact and self.replay.is_complete


def replay(
    bag: str | Path, *, namespace: str | None = None, simulation: Simulation | None = None
) -> list[ReplayResult]:
    """Simulate all runs in a bag again, like `vehicle_roll_sim replay`.

    namespace: selects a vehicle if the bag has several. simulation: required if the bag has no
    description of the simulation; otherwise it must agree with the description. Raises InputError,
    also if no run was recorded from its reset on. Requires the package rosbags.
    """
    if simulation is not None:
        given("simulation", simulation, Simulation)
    return list(replays(path_of(bag, FIELD), namespace, simulation))


def replays(folder: Path, namespace: str | None, told: Simulation | None) -> Iterator[ReplayResult]:
    """Replay the runs of a bag one by one; see `replay`."""
    need_library(FIELD)
    from vehicle_roll_sim.bags.reading import recorded_runs  # their library is optional
    from vehicle_roll_sim.bags.replay import replay as replay_run

    runs = recorded_runs(folder, namespace)
    if not any(run.begins_at_a_reset for run in runs):
        allowed = "a recording of at least one run from its reset (time 0) on"
        raise InputError(FIELD, str(folder), allowed, f"{folder}: the recording starts in mid-run")
    for run in runs:
        begin = float(run.states[0]["time"])
        if not run.begins_at_a_reset:
            yield ReplayResult(begin, None, None)
            continue
        recorded = described(run.description) if run.description else None
        simulation = _simulation(recorded, told, folder)
        period = recorded.period if recorded else None
        yield ReplayResult(begin, recorded, replay_run(run, simulation, period))


def _simulation(recorded: Described | None, told: Simulation | None, folder: Path) -> Simulation:
    """The simulation to replay; raises InputError if bag and caller disagree or neither has one."""
    if recorded is None:
        if told is None:
            allowed = "describe the simulation by options, as for `run`"
            problem = f"{folder} has no description of the simulation"
            raise InputError(FIELD, str(folder), allowed, problem)
        return told
    if told is not None and (differs := difference(recorded.simulation, told)):
        name, theirs, ours = differs
        problem = f"{folder}: the bag has {theirs}"
        raise InputError(name, theirs, f"the options give {ours}", problem)
    return recorded.simulation
