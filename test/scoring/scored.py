"""Scores without ROS: controllers as functions, which answer each set in this process."""

import dataclasses
from collections.abc import Callable, Iterable

import numpy as np

from vehicle_roll_sim import Options, preset
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.scoring.driven import Driven, drive_again, drive_alone
from vehicle_roll_sim.scoring.plan import Ladder, Setup
from vehicle_roll_sim.scoring.results import Climb, Score, result_alone, result_controlled
from vehicle_roll_sim.simulation.command import Command, command_at
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_ANGLE, DEFAULT_STEP
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import Simulation

PERIOD = 0.01
"""s"""
Answer = Callable[[Simulation, Command], tuple[Command, bool]]
"""What a controller makes of the driver's command, and whether it warns."""


def make_setup(**values) -> Setup:
    vehicle = preset().with_values(values) if values else preset()
    options = Options().for_vehicle(vehicle)
    return Setup(vehicle, options, DEFAULT_STEP, DEFAULT_ROLLOVER_ANGLE, Road(), PERIOD)


def drive(ladder: Ladder, level: float, setup: Setup, answer: Answer) -> tuple[Driven, Simulation]:
    """Drive as the bench does: the answer to a set acts in the period after it."""
    manoeuvre = ladder.manoeuvre(setup, level)
    simulation = ladder.simulation(setup)
    simulation.reset(manoeuvre.speed)
    driver, given, warned = manoeuvre.driver(), [], []
    while True:
        command = command_at(driver, simulation.time, simulation.state)
        command, warns = answer(simulation, command)
        warned.append(warns)
        is_over = simulation.time >= manoeuvre.duration - 1e-9
        if is_over or simulation.condition is not Condition.RUNNING:
            break
        simulation.step(command, PERIOD)
        given.append(command.records())
    return Driven(np.concatenate(given), np.array(warned)), simulation


def brake(torque: float) -> Answer:
    """Brake the right front wheel all the time, and warn while the vehicle rolls."""

    def answer(simulation: Simulation, command: Command) -> tuple[Command, bool]:
        braked = dataclasses.replace(command, brake_torque=(0.0, torque, 0.0, 0.0))
        return braked, bool(abs(simulation.state["roll"]) > 0.1)

    return answer


def scored(name: str, ladders: Iterable[Ladder], setup: Setup, answer: Answer, kept: dict) -> Score:
    """The score of a controller; kept: gets the commands of each run by its name."""
    climbs = []
    for ladder in ladders:
        alone, controlled = {}, {}
        for level in ladder.levels:
            without = drive_alone(ladder, level, setup)
            alone[level] = result_alone(level, without)
            if any(each.has_failed for each in controlled.values()):
                continue
            driven, _ = drive(ladder, level, setup, answer)
            kept[ladder.name(level)] = driven
            found = drive_again(ladder, level, setup, driven)
            controlled[level] = result_controlled(level, without, found, driven)
        climbs.append(Climb(ladder, alone, controlled))
    return Score(name, tuple(climbs))
