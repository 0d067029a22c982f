"""Model 2, written down a second time: from vehicle file and state to motion, forces and energy.

Everything is in the ground frame and by rotation matrices; derivatives are complex steps. Curves
over travel are taken from `vehicle.travel_curves` and those of springs and dampers from
`suspension_details`, which have tests of their own.
"""

import dataclasses

import numpy as np
from random_states import attitude, inertia_tensor, wheel_positions
from tire_springs import tire_energies

from vehicle_roll_sim import Vehicle
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.suspension_details import (
    damper_of,
    damper_travel_of,
    spring_of,
    spring_travel_of,
)

G, AIR_DENSITY = 9.81, 1.225
SIDES = (1.0, -1.0, 1.0, -1.0)
AXLES = ("front", "front", "rear", "rear")
OTHER = [1, 0, 3, 2]
SMALL = 1e-30
"""The complex step."""


def curves(vehicle: Vehicle, i: int, travel) -> dict:
    """What changes with the travel of a left wheel, in the signs of frame 1; complex too."""
    found = {}
    for name, curve in vehicle.travel_curves[AXLES[i]].items():
        polynomial = along(curve, travel)
        short = name.removeprefix(f"{AXLES[i]}_").removesuffix("_change")
        found[short] = polynomial(travel - travel.real)
    return found


def along(curve, argument) -> np.polynomial.Polynomial:
    """The polynomial of a curve that holds at an argument, counted from its real part."""
    return np.polynomial.Polynomial(curve.piece(argument.real, argument.real))


def spring_energy(vehicle: Vehicle, i: int, travel):
    """Energy that the spring and the stops of a wheel take up (J), from the real travel on."""
    axle = AXLES[i]
    moved = spring_travel_of(vehicle, axle)
    rest = vehicle.static_suspension_compression[i] * along(moved, 0.0).deriv()(0.0)
    compression = rest + along(moved, travel)(travel - travel.real)
    force = along(spring_of(vehicle, axle), compression)
    total = force.integ()(compression - compression.real)
    for stop, inwards in (("bump", travel), ("rebound", -travel)):
        clearance, stiffness, progression = (
            getattr(vehicle, f"{axle}_{stop}_stop_{name}") or 0.0
            for name in ("clearance", "stiffness", "progression")
        )
        depth = inwards - clearance
        if depth.real > 0.0:
            total += stiffness * depth**2 / 2 + progression * depth**3 / 6
    return total


def damper_power(vehicle: Vehicle, i: int, travel: float, rate: float) -> float:
    """Power that a damper takes (W)."""
    axle = AXLES[i]
    speed = along(damper_travel_of(vehicle, axle), travel).deriv()(0.0) * rate
    return along(damper_of(vehicle, axle), speed)(0.0) * speed


def about(axis: int, angle) -> np.ndarray:
    """The rotation by an angle about x, y or z."""
    angles = [0.0, 0.0, 0.0]
    angles[axis] = angle
    return attitude(*angles)


def carrier(vehicle: Vehicle, i: int, travel) -> np.ndarray:
    """The rotation of a wheel's carrier against the body."""
    at, side = curves(vehicle, i, travel), SIDES[i]
    static = -side * getattr(vehicle, f"{AXLES[i]}_camber")
    return (
        about(2, side * at["toe"])
        @ about(0, static + side * at["camber"])
        @ about(1, at["carrier_pitch"])
    )


def centre(vehicle: Vehicle, i: int, travel) -> np.ndarray:
    """Of a wheel in frame 1 (m)."""
    at, side = curves(vehicle, i, travel), SIDES[i]
    lean = side * at["camber"] - side * getattr(vehicle, f"{AXLES[i]}_camber")
    x, y = wheel_positions(vehicle)[i]
    flat = vehicle.static_loaded_radius[i]
    height = vehicle.static_wheel_height[i] - vehicle.cg_height
    outwards = y + side * at["half_track"] - flat * np.sin(lean)
    return np.array([x + at["longitudinal"], outwards, height + travel])


@dataclasses.dataclass(frozen=True)
class Wheel:
    """A wheel at a state, in the ground frame.

    travel, rate (m, m/s); centre, velocity of the centre; spin_axis; inclination; cosine of it;
    radius (loaded, m); deflection (m), not clipped; contact point.
    """

    travel: complex
    rate: complex
    centre: np.ndarray
    velocity: np.ndarray
    spin_axis: np.ndarray
    cosine: complex
    radius: complex
    deflection: complex
    contact: np.ndarray


def wheel(vehicle: Vehicle, i: int, state, steering: float) -> Wheel:
    """A wheel at a state, which may be complex."""
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    turning = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
    velocity = np.array([state["u"], state["v"], state["w"]])
    travel = state["suspension_compression"][i] - vehicle.static_suspension_compression[i]
    place = centre(vehicle, i, travel)
    path = path_of(vehicle, i, travel)
    carried = velocity + np.cross(turning, place)
    rate = state["unsprung_velocity"][i] - carried[2]
    axis = rotation @ carrier(vehicle, i, travel) @ about(2, steering) @ np.array([0.0, 1.0, 0.0])
    over = np.array([state["x"], state["y"], state["z"]]) + rotation @ place
    up = np.array([0.0, 0.0, 1.0])
    cosine = np.sqrt(1.0 - axis[2] ** 2)
    unloaded = vehicle.per_wheel("tire_radius")[i]
    deflection = unloaded - over[2] / cosine
    radius = unloaded - deflection if deflection.real > 0.0 else unloaded
    contact = over + radius * (axis[2] * axis - up) / cosine
    return Wheel(
        travel, rate, over, rotation @ (carried + rate * path), axis, cosine, radius, deflection,
        contact,
    )  # fmt: skip


def path_of(vehicle: Vehicle, i: int, travel) -> np.ndarray:
    """dP/dq of the wheel centre, in frame 1, from the derivatives of the polynomials."""
    axle, side = AXLES[i], SIDES[i]
    slopes, values = {}, {}
    for name, curve in vehicle.travel_curves[axle].items():
        polynomial = along(curve, travel)
        short = name.removeprefix(f"{axle}_").removesuffix("_change")
        further = travel - travel.real
        values[short], slopes[short] = polynomial(further), polynomial.deriv()(further)
    lean = side * values["camber"] - side * getattr(vehicle, f"{axle}_camber")
    inward = vehicle.static_loaded_radius[i] * np.cos(lean) * side * slopes["camber"]
    return np.array([slopes["longitudinal"], side * slopes["half_track"] - inward, 1.0])


def turning_of_carrier(vehicle: Vehicle, i: int, travel: float) -> np.ndarray:
    """kappa', the rotation vector of the carrier per travel, in frame 1: from R' R^T."""
    slope = carrier(vehicle, i, travel + 1j * SMALL).imag / SMALL
    spin = slope @ carrier(vehicle, i, travel).T
    return np.array([spin[2, 1], spin[0, 2], spin[1, 0]])


def wheels(vehicle: Vehicle, state, command) -> list[Wheel]:
    steering = np.repeat([command["steering"], command["rear_steering"]], 2)
    return [wheel(vehicle, i, state, steering[i]) for i in range(4)]


def energy(vehicle: Vehicle, road: Road, state, command):
    """Kinetic, potential and elastic energy (J); that of springs from the real state on."""
    down, ahead, across = road.gravity(G)
    gravity = np.array([ahead, across, -down])
    rates = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
    velocity = np.array([state["u"], state["v"], state["w"]])
    body = np.array([state["x"], state["y"], state["z"]])
    total = vehicle.sprung_mass * (velocity @ velocity / 2 - gravity @ body)
    total += rates @ inertia_tensor(vehicle) @ rates / 2
    total += vehicle.wheel_inertia * (state["wheel_speed"] ** 2).sum() / 2
    travel = state["suspension_compression"] - vehicle.static_suspension_compression
    apart = travel - travel[OTHER]  # bars are without load at rest
    total += vehicle.bar_rate @ apart**2 / 4
    for i, each in enumerate(wheels(vehicle, state, command)):
        mass = vehicle.per_wheel("unsprung_mass")[i]
        total += spring_energy(vehicle, i, each.travel)
        total += mass * (each.velocity @ each.velocity / 2 - gravity @ each.centre)
        if each.deflection.real > 0.0:
            total += tire_energies(vehicle, each.deflection)[i]
    return total


def momenta(vehicle: Vehicle, state, command) -> np.ndarray:
    """Linear momentum, and angular momentum about the origin of the ground frame; shape (6,)."""
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    rates = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
    body = np.array([state["x"], state["y"], state["z"]])
    linear = vehicle.sprung_mass * rotation @ np.array([state["u"], state["v"], state["w"]])
    angular = rotation @ inertia_tensor(vehicle) @ rates + np.cross(body, linear)
    for i, each in enumerate(wheels(vehicle, state, command)):
        part = vehicle.per_wheel("unsprung_mass")[i] * each.velocity
        linear, angular = linear + part, angular + np.cross(each.centre, part)
    return np.concatenate((linear, angular))
