"""Models driven by logs, many at the same time."""

from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.batch.evaluate import checked_workers
from vehicle_roll_sim.batch.fleet import Fleet
from vehicle_roll_sim.comparison.driving import Driven, Driving, driven_of, noted
from vehicle_roll_sim.comparison.log_commands import LogCommands, Plan
from vehicle_roll_sim.logs.log import Log
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import COMMAND, STATE_NAMES
from vehicle_roll_sim.simulation.simulation import Simulation

VELOCITY = [STATE_NAMES.index(name) for name in ("u", "v", "w")]
WORTH_A_THREAD = 16
"""Steps of models, 10 us each: to hand a period over to a thread and back takes 50 us."""


def drive_all(
    pairs: Sequence[tuple[Log, Simulation]], driving: Driving, workers: int | None = None
) -> list[Driven]:
    """Drive each simulation by its log, from the run-up to its end or until the model stops.

    Each result is that of the simulation alone, bit for bit. All have one integration step.
    workers: number of threads at most, by default one for each processor. Raises InputError.
    """
    places = [_Place(log, simulation, driving) for log, simulation in pairs]
    worth = sum(place.plan.steps for place in places) // WORTH_A_THREAD
    threads = min(checked_workers(workers), max(worth, 1))
    fleet = Fleet(len(places), pairs[0][1].step_ns, threads)
    try:
        for i, place in enumerate(places):
            place.simulation.reset(float(place.commands.speeds[0]))
            fleet.place(i, place.simulation)
        table = _drive(fleet, places)
        ends, conditions = fleet.times_ns.tolist(), [Condition(each) for each in fleet.conditions]
    finally:
        fleet.close()
    return [
        place.driven(table[:, i], end, condition)
        for i, (place, end, condition) in enumerate(zip(places, ends, conditions, strict=True))
    ]


class _Place:
    """One model of the fleet."""

    def __init__(self, log: Log, simulation: Simulation, driving: Driving):
        self.log, self.simulation = log, simulation
        self.plan = Plan.of(log, driving.run_up, simulation.step_ns)
        self.commands = LogCommands(log, simulation.vehicle, driving.holds_speed, self.plan)

    def driven(self, table: np.ndarray, time_ns: int, condition: Condition) -> Driven:
        """What the model did. table: of `noted`, shape (times, quantities). time_ns: its end."""
        rows = 1 + -(-time_ns // (self.plan.steps * self.simulation.step_ns))
        return driven_of(self.log, self.plan, self.commands, table[:rows].T, condition)


def _drive(fleet: Fleet, places: list[_Place]) -> np.ndarray:
    """Drive all to their ends; returns what was noted, shape (times, places, quantities)."""
    commands = np.zeros(len(places), COMMAND)
    steps, held, given = _together(places)
    distribution = np.array([place.commands.controller.distribution for place in places])
    has_eight_dof = any(place.simulation.options.has_eight_dof for place in places)
    first = _noted(fleet, places, has_eight_dof)
    table = np.empty((len(steps) + 1, *first.shape))
    table[0] = first
    for k in range(len(steps)):
        commands["steering"], commands["rear_steering"] = given["steering"][k], given["rear"][k]
        commands["wheel_torque"] = given["drives"][k]
        commands["brake_torque"] = given["brakes"][k]
        if held[k]:
            _hold_speeds(commands, fleet, places, k, held[k], distribution)
        fleet.step(commands, steps[k])
        table[k + 1] = _noted(fleet, places, has_eight_dof)
    return table


def _together(places: list[_Place]) -> tuple[np.ndarray, list[list[int]], dict[str, np.ndarray]]:
    """By period: steps of each place, which places hold their speeds, and commands of all.

    Shapes (longest, places, ...); 0 after the end of a log.
    """
    longest = max(place.plan.periods for place in places)

    def stacked(columns: list[np.ndarray]) -> np.ndarray:
        table = np.zeros((longest, len(columns), *columns[0].shape[1:]), columns[0].dtype)
        for i, each in enumerate(columns):
            table[: len(each), i] = each
        return table

    given = [place.commands for place in places]
    is_held = stacked([each.is_held for each in given])
    steps = stacked([np.full(place.plan.periods, place.plan.steps) for place in places])
    return (
        steps,
        _places_of(is_held),
        {
            "steering": stacked([each.steering for each in given]),
            "rear": stacked([each.rear_steering for each in given]),
            "drives": stacked([each.wheel_torques for each in given]),
            "brakes": stacked([each.brake_torques for each in given]),
        },
    )


def _places_of(is_held: np.ndarray) -> list[list[int]]:
    """Where each row is true."""
    found = [[] for _ in is_held]
    for k in np.flatnonzero(is_held.any(axis=1)):
        found[k] = np.flatnonzero(is_held[k]).tolist()
    return found


def _hold_speeds(
    commands: np.ndarray,
    fleet: Fleet,
    places: list[_Place],
    k: int,
    held: list[int],
    distribution: np.ndarray,
) -> None:
    """Set the torques of the places whose speeds are held in period k."""
    speeds, slopes = fleet.states["u"].tolist(), fleet.outputs["slope_gravity"][:, 0].tolist()
    for i in held:
        of_place = places[i].commands
        target = float(of_place.speeds[k])
        drive, brake = of_place.controller.torques(
            target, speeds[i], places[i].plan.period, slopes[i]
        )
        commands["wheel_torque"][i] = drive * distribution[i]
        commands["brake_torque"][i] = brake


def _noted(fleet: Fleet, places: list[_Place], has_eight_dof: bool) -> np.ndarray:
    """`noted` of all places, shape (places, quantities). has_eight_dof: whether any model has."""
    if has_eight_dof:
        pairs = zip(places, fleet.states, strict=True)
        motions = [place.simulation.cg_motion_at(state) for place, state in pairs]
        velocity = np.array(motions)[:, 3:]
    else:
        velocity = fleet.state_vectors[:, VELOCITY]
    return noted(fleet.state_vectors, fleet.output_vectors, velocity)
