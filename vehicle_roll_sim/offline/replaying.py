"""Recorded runs simulated again on the commands that were applied."""

import dataclasses
from collections.abc import Iterator
from pathlib import Path

from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.declaration import InputError, given
from vehicle_roll_sim.offline.tables import path_of
from vehicle_roll_sim.simulation.description import Described, described, difference
from vehicle_roll_sim.simulation.simulation import Simulation

FIELD = "BAG"


@dataclasses.dataclass(frozen=True)
class ReplayResult:
    """One recorded run: from which simulated time on it is known (s), and how it came out again.

    recorded: what the bag says of the simulation, its version and machine; None where it does not.
    replay: end, periods, difference, is_exact, is_complete, ... (bags.replay.Replay); None for a
    run that does not begin at a reset.
    """

    begin: float
    recorded: Described | None
    replay: object | None

    @property
    def is_reproduced(self) -> bool:
        """Whether the whole run was reproduced to the bit."""
        return self.replay is not None and self.replay.is_exact and self.replay.is_complete


def replay(
    bag: str | Path, *, namespace: str | None = None, simulation: Simulation | None = None
) -> list[ReplayResult]:
    """Simulate all runs in a bag again, as `vehicle_roll_sim replay` does.

    namespace: vehicle, if the bag has several. simulation: for a bag that does not say what was
    simulated; one that does must agree with it. Raises InputError, also where no run begins at a
    reset; needs the package rosbags.
    """
    if simulation is not None:
        given("simulation", simulation, Simulation)
    return list(replays(path_of(bag, FIELD), namespace, simulation))


def replays(folder: Path, namespace: str | None, told: Simulation | None) -> Iterator[ReplayResult]:
    """The runs of a bag one by one, as `replay` gives them."""
    need_library(FIELD)
    from vehicle_roll_sim.bags.reading import recorded_runs  # their library is optional
    from vehicle_roll_sim.bags.replay import replay as replay_run

    runs = recorded_runs(folder, namespace)
    if not any(run.begins_at_a_reset for run in runs):
        allowed = "a recording of at least one run from its reset on, time 0"
        raise InputError(FIELD, str(folder), allowed, f"{folder}: it begins under way")
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
    """What was recorded; raises InputError where bag and caller disagree, or neither says it."""
    if recorded is None:
        if told is None:
            allowed = "options that say what was simulated, as in `run`"
            raise InputError(FIELD, str(folder), allowed, f"{folder} does not say it")
        return told
    if told is not None and (differs := difference(recorded.simulation, told)):
        name, theirs, ours = differs
        problem = f"{folder}: the bag has {theirs}"
        raise InputError(name, theirs, f"the options say {ours}", problem)
    return recorded.simulation
