"""Helpers to compare and drive simulations in this folder."""

import math

import numpy as np

from vehicle_roll_sim.model.records import COMMAND


def everything(simulation) -> tuple:
    """Everything observable of a simulation, bit for bit."""
    records = (simulation.state, simulation.outputs, simulation.events)
    return simulation.time_ns, simulation.condition, b"".join(part.tobytes() for part in records)


def turn(degrees: float, start: float = 0.1, seconds: float = 0.25):
    """A programme: road-wheel angle from 0 at `start` (s) to `degrees` within `seconds`."""

    def programme(times: np.ndarray) -> np.ndarray:
        commands = np.zeros(len(times), COMMAND)
        share = np.clip((times - start) / seconds, 0.0, 1.0)
        commands["steering"] = math.radians(degrees) * share
        commands["wheel_torque"][:, 2:] = 50.0 * times[:, np.newaxis]
        return commands

    return programme
