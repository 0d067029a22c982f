"""Vehicle roll dynamics in real time: the 14 degree-of-freedom model of Shim and Ghike (2007)."""

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.events import Condition
from vehicle_roll_sim.model.records import LF, LR, RF, RR, WHEELS
from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.simulation.command import Command
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire_file import Tire, load_tire
from vehicle_roll_sim.vehicle.vehicle_file import load_vehicle, preset

__all__ = [
    "LF",
    "LR",
    "RF",
    "RR",
    "WHEELS",
    "Command",
    "Condition",
    "InputError",
    "Options",
    "RollPlane",
    "Simulation",
    "Tire",
    "Vehicle",
    "load_tire",
    "load_vehicle",
    "preset",
]
