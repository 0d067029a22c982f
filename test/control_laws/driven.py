"""Runs of the reference vehicle with control laws, for several test files."""

import dataclasses

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.catalogue import manoeuvre_named
from vehicle_roll_sim.runs.control_law import ControlLaw, Controlled
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run

REFERENCE = preset()


def filled_in(name: str, **values) -> Manoeuvre:
    """A manoeuvre of the catalogue for the reference vehicle, with some values replaced."""
    manoeuvre = dataclasses.replace(manoeuvre_named(name), **values)
    return manoeuvre.for_vehicle(REFERENCE, Options())


def begun(law: ControlLaw) -> ControlLaw:
    """The law, ready for a run of the reference vehicle."""
    law.begin(REFERENCE, Options())
    return law


def driven(manoeuvre: Manoeuvre, *laws: ControlLaw) -> History:
    """The history of the reference vehicle, with laws beside the driver."""
    simulation = Simulation(REFERENCE)
    simulation.reset(manoeuvre.speed)
    driver = Controlled(simulation, manoeuvre.driver(), *laws)
    return run(simulation, driver, manoeuvre.duration)


def motion_at(history: History, row: int) -> dict[str, float]:
    """What a law hears at a row of a history whose rows are the periods."""
    names = ("time", "steering", "u", "v", "yaw_rate", "roll", "roll_rate")
    return {name: float(history[name][row]) for name in names}


def mirrored(motion: dict[str, float]) -> dict[str, float]:
    """The motion as in a mirror: everything to the other side."""
    return {name: value if name in ("time", "u") else -value for name, value in motion.items()}
