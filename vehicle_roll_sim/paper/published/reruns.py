"""Published quantities, computed here: each from a vehicle and the conditions of the source.

Steady turns are trims of model 1 with steady-state slip; they need no run.
"""

import math
from collections.abc import Callable

from scipy import optimize

from vehicle_roll_sim.analysis.handling import gradients_of
from vehicle_roll_sim.analysis.trim import STEERING, Trim, find_trim
from vehicle_roll_sim.manoeuvres.catalogue import RampAndHold
from vehicle_roll_sim.manoeuvres.driving import history_of
from vehicle_roll_sim.manoeuvres.on_roads.tilt_table import TiltTableTest
from vehicle_roll_sim.model.records import YAW_RATE, V
from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.simulation.options import OFF, Options
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.parameters import Vehicle

FORCES = {"tire_moments": OFF, "contact_patch_shift": OFF}
"""The sources have tires with forces only, in the wheel plane."""
STEADY, PARKED = Options(**FORCES, steady_state_slip=True), Options(**FORCES)
PER_G = math.degrees(GRAVITY)
"""deg/g per rad/(m/s^2)."""
KM_H = 3.6
"""km/h per m/s."""
SLIGHT = 0.002
"""rad: a road-wheel angle for gains about straight ahead."""
SPEEDS = 8.0, 30.0
"""m/s: where tangent and characteristic speed are sought."""
TILT = TiltTableTest(speed=0.0, rate=1.0, start=0.5, duration=60.0)
BEND = RampAndHold(
    speed=15.0,
    amplitude=math.degrees(0.15),
    rate=math.degrees(0.15),
    start=0.0,
    duration=1.0,
)
"""Coasting from 15 m/s while the road wheels are turned at 0.15 rad/s."""


def static_stability_factor(vehicle: Vehicle) -> float:
    """T/2h of the rigid vehicle (-)."""
    return RollPlane(vehicle.record(), suspended=False).static_stability_factor


def total_cg_height(vehicle: Vehicle) -> float:
    """Height of the c.g. of sprung and unsprung masses together (m)."""
    return RollPlane(vehicle.record()).cg_height


def tilt_table_ratio(vehicle: Vehicle) -> float:
    """Tangent of the angle of a table at which both wheels of the raised side are off it (-)."""
    simulation = Simulation(vehicle, PARKED, road=TILT.own_road())
    simulation.reset(TILT.speed)
    _, two, _ = TILT.angles(history_of(simulation, TILT, TILT.duration))
    return math.tan(two)


def understeer_gradient(vehicle: Vehicle) -> float:
    """Of gentle turns to both sides (deg/g)."""
    return gradients_of(vehicle, STEADY, speed=SPEEDS[1] / 2).understeer * PER_G


def roll_gradient(vehicle: Vehicle, speed: float) -> float:
    """Of gentle turns to both sides (deg/g)."""
    return gradients_of(vehicle, STEADY, speed=speed).roll * PER_G


def steering_gradient(vehicle: Vehicle, speed: float) -> float:
    """Road-wheel angle over lateral acceleration at a speed (deg/g)."""
    turn = find_trim(vehicle, STEADY, speed=speed, lateral_acceleration=1.0)
    return float(turn.inputs[STEERING]) * PER_G


def curvature_gain(vehicle: Vehicle, speed: float, steering: float) -> float:
    """Yaw rate over speed and road-wheel angle in a steady turn (1/m)."""
    return _yaw_rate(_turn(vehicle, speed, steering)) / (speed * steering)


def characteristic_speed(vehicle: Vehicle) -> float:
    """The speed with the largest yaw rate gain (km/h)."""
    found = optimize.minimize_scalar(
        lambda speed: -_yaw_rate(_turn(vehicle, speed)),
        bounds=SPEEDS,
        method="bounded",
        options={"xatol": 0.01},
    )
    return float(found.x) * KM_H


def tangent_speed(vehicle: Vehicle) -> float:
    """The speed at which the whole c.g. moves along the x axis in a slight turn (km/h)."""
    car = vehicle.record()[0]
    unsprung = car["unsprung_mass"]
    ahead = float(unsprung @ car["x"] / (car["sprung_mass"] + unsprung.sum()))

    def aside(speed: float) -> float:
        turn = _turn(vehicle, speed)
        return turn.state[V] + ahead * _yaw_rate(turn)

    return optimize.brentq(aside, *SPEEDS) * KM_H


def bend_yaw_rate(vehicle: Vehicle) -> float:
    """At the end of BEND (deg/s)."""
    return math.degrees(_bend(vehicle, "yaw_rate"))


def bend_roll(vehicle: Vehicle) -> float:
    """At the end of BEND (deg)."""
    return math.degrees(_bend(vehicle, "roll"))


def bend_displacement(vehicle: Vehicle) -> float:
    """To the left, at the end of BEND (m)."""
    return _bend(vehicle, "y")


def bend_sideslip(vehicle: Vehicle) -> float:
    """Of the c.g. of the body, at the end of BEND (deg)."""
    return math.degrees(math.atan2(_bend(vehicle, "v"), _bend(vehicle, "u")))


def _bend(vehicle: Vehicle, name: str) -> float:
    simulation = Simulation(vehicle, STEADY)
    simulation.reset(BEND.speed)
    return float(history_of(simulation, BEND, BEND.duration)[name][-1])


def _turn(vehicle: Vehicle, speed: float, steering: float = SLIGHT) -> Trim:
    return find_trim(vehicle, STEADY, speed=speed, steering=steering)


def _yaw_rate(turn: Trim) -> float:
    return float(turn.state[YAW_RATE])


RERUNS: dict[str, Callable[..., float]] = {
    rerun.__name__: rerun
    for rerun in (
        *(static_stability_factor, total_cg_height, tilt_table_ratio),
        *(understeer_gradient, roll_gradient, steering_gradient, curvature_gain),
        *(characteristic_speed, tangent_speed),
        *(bend_yaw_rate, bend_roll, bend_displacement, bend_sideslip),
    )
}
"""By the names of the files of `data/`."""
