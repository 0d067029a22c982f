"""Trims and linear models of the reference vehicle, and their mirror images."""

import functools
import math

import numpy as np

from vehicle_roll_sim import Command, Options, Simulation, preset
from vehicle_roll_sim.analysis.linear_model import LinearModel, linearize
from vehicle_roll_sim.analysis.trim import Trim, find_trim
from vehicle_roll_sim.model.records import U

SPEED = 50 / 3.6
"""m/s"""
REFERENCE = preset()
CHANGES_SIGN = {
    *("v", "roll", "roll_rate", "yaw_rate", "steering", "rear_steering"),
    *("lateral_acceleration", "sideslip_angle", "load_transfer_ratio"),
    *(f"lateral_slip_{wheel}" for wheel in ("lf", "rf", "lr", "rr")),
}
"""What a mirror turns round."""
OPPOSITE = {"lf": "rf", "rf": "lf", "lr": "rr", "rr": "lr"}


@functools.cache
def reference_model(model: str = "1", steering: float = 0.0) -> LinearModel:
    """At 50 km/h; steering in degrees."""
    angle = math.radians(steering)
    return linearize(find_trim(REFERENCE, Options(model=model), speed=SPEED, steering=angle))


def mirror(names: tuple[str, ...]) -> np.ndarray:
    """The matrix that has left and right change places among elements of these names."""
    matrix = np.zeros((len(names), len(names)))
    for i, name in enumerate(names):
        other = name[:-2] + OPPOSITE[name[-2:]] if name[-2:] in OPPOSITE else name
        matrix[i, names.index(other)] = -1.0 if name in CHANGES_SIGN else 1.0
    return matrix


def command_of(inputs: np.ndarray) -> Command:
    """The command that the inputs of a linear model are."""
    torques, forces, wind = tuple(inputs[2:6]), tuple(inputs[6:10]), tuple(inputs[10:]) or (0, 0)
    return Command(float(inputs[0]), float(inputs[1]), torques, normal_force=forces, wind=wind)


def simulation_in(trim: Trim) -> Simulation:
    """A simulation that begins in a trim."""
    simulation = Simulation(trim.plant.vehicle, trim.plant.options)
    simulation.reset(float(trim.state[U]))
    simulation.state_vector[:] = trim.state
    return simulation
