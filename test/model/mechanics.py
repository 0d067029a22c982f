"""Momentum and energy of the vehicle and everything that changes them, in the ground frame.

The bodies are the sprung mass and four point masses at the wheel centres; no rotating frame can
hide a term. Rates are taken along the model's own by a complex step, without truncation error.
"""

import numpy as np
from random_states import (
    attitude,
    attitudes,
    inertia_tensor,
    strut_lengths,
    wheel_centres,
    wheel_positions,
)
from tire_springs import tire_energies

from vehicle_roll_sim.model.records import STATE
from vehicle_roll_sim.simulation.road import Road

G = 9.81
GRAVITY = np.array([0.0, 0.0, -G])
AIR_DENSITY = 1.225
"""kg/m^3"""
COMPLEX_STEP = 1e-30


def along(state, rates) -> dict:
    """The state a complex step further along its rates."""
    return {name: state[name] + 1j * COMPLEX_STEP * rates[name] for name in STATE.names}


def slope(values):
    return values.imag / COMPLEX_STEP


def momenta(vehicle, state) -> tuple[np.ndarray, np.ndarray]:
    """Linear momentum, and angular momentum about the origin of the ground frame."""
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    rates = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
    body = np.array([state["u"], state["v"], state["w"]])
    position = np.array([state["x"], state["y"], state["z"]])
    linear = vehicle.sprung_mass * rotation @ body
    angular = rotation @ inertia_tensor(vehicle) @ rates + np.cross(position, linear)
    parts = vehicle.per_wheel("unsprung_mass")[:, None] * (unsprung(vehicle, state) @ rotation.T)
    moments = np.cross(wheel_centres(vehicle, state), parts)
    return linear + parts.sum(axis=0), angular + moments.sum(axis=0)


def external(vehicle, state, outputs) -> tuple[np.ndarray, np.ndarray]:
    """Forces on the vehicle and the points that they act at, over the ground."""
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    heading = attitude(0.0, 0.0, state["yaw"])
    centres = wheel_centres(vehicle, state)
    contacts = centres - outputs["loaded_radius"][:, None] * rotation[:, 2]
    parts = ("longitudinal_force", "lateral_force", "normal_force")
    tires = np.column_stack([outputs[name] for name in parts]) @ heading.T
    weights = vehicle.per_wheel("unsprung_mass")[:, None] * GRAVITY
    body = np.array([state["x"], state["y"], state["z"]])
    of_body = vehicle.sprung_mass * GRAVITY - drag(vehicle, state) * rotation[:, 0]
    return np.vstack([tires, weights, of_body]), np.vstack([contacts, centres, body])


def couples(state, outputs) -> np.ndarray:
    """Moments of the road on the wheels, beside those of the forces, over the ground (N m)."""
    names = ("overturning_moment", "rolling_resistance_moment", "aligning_moment")
    along_wheels = np.stack([outputs[name] for name in names], axis=-1)
    yaw = of_all_wheels(state["yaw"]) + outputs["steering"]
    return (turned_by(yaw) @ along_wheels[..., None])[..., 0]


def spin_axes(vehicle, state, outputs) -> np.ndarray:
    """Upward slope of the axes that the wheels spin about: sine of their inclination to the road.

    From the axis itself, turned by steering about the body's z axis, and by the static camber.
    """
    rotation = pose(state)
    angle = outputs["steering"]
    left = np.stack([-np.sin(angle), np.cos(angle), 0.0 * angle], axis=-1)
    camber = np.zeros(4)
    camber[:2] = -vehicle.front_camber, vehicle.front_camber
    camber[2:] = -vehicle.rear_camber, vehicle.rear_camber
    return np.sin(np.arcsin((left @ rotation.swapaxes(-1, -2))[..., 2]) + camber)


def drag(vehicle, state) -> float:
    """Force of the air at the c.g., backwards along the body's x axis (N)."""
    u = state["u"]
    return AIR_DENSITY / 2 * vehicle.drag_area * u * abs(u)


def unsprung(vehicle, state) -> np.ndarray:
    """Velocities of the wheel centres along the body's axes (m/s), a row each."""
    x, y = wheel_positions(vehicle).T
    lengths = strut_lengths(vehicle, state["suspension_compression"])
    names = ("u", "v", "roll_rate", "pitch_rate", "yaw_rate")
    u, v, wx, wy, wz = (of_all_wheels(state[name]) for name in names)
    ahead, across = u - y * wz - lengths * wy, v + x * wz + lengths * wx
    return np.stack([ahead, across, state["unsprung_velocity"]], axis=-1)


def energy(vehicle, road: Road, state) -> float:
    """Kinetic, potential and elastic energy (J)."""
    down, ahead, across = road.gravity(G)
    gravity = np.array([ahead, across, -down])
    masses = vehicle.per_wheel("unsprung_mass")
    body = np.array([state["x"], state["y"], state["z"]])
    velocity = np.array([state["u"], state["v"], state["w"]])
    rates = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
    total = vehicle.sprung_mass * velocity @ velocity / 2
    total += rates @ inertia_tensor(vehicle) @ rates / 2
    total += masses @ (unsprung(vehicle, state) ** 2).sum(axis=1) / 2
    total += vehicle.wheel_inertia * (state["wheel_speed"] ** 2).sum() / 2
    total -= vehicle.sprung_mass * gravity @ body
    total -= masses @ (wheel_centres(vehicle, state) @ gravity)
    springs = vehicle.per_wheel("spring_stiffness")
    total += springs @ state["suspension_compression"] ** 2 / 2
    return total + tire_energies(vehicle, np.maximum(state["tire_compression"], 0.0)).sum()


def turning(state, outputs) -> np.ndarray:
    """Velocities of the contact points about the wheel centres along the body's axes (m/s)."""
    radius = outputs["loaded_radius"]
    nodding, leaning = of_all_wheels(state["pitch_rate"]), of_all_wheels(state["roll_rate"])
    return np.stack([-nodding * radius, leaning * radius, 0 * radius], axis=-1)


def pose(state) -> np.ndarray:
    """Body to ground, shape (..., 3, 3)."""
    return attitudes(state["roll"], state["pitch"], state["yaw"])


def turned_by(yaw) -> np.ndarray:
    """The rotation about the vertical alone, shape (..., 3, 3)."""
    return attitudes(0.0 * yaw, 0.0 * yaw, yaw)


def of_all_wheels(value) -> np.ndarray:
    """A value of the body beside those of its wheels, which are along the last axis."""
    return np.asarray(value)[..., None]


def power_of_lever(state, outputs) -> np.ndarray:
    """See `powers`."""
    up = pose(state)[..., 2, :]
    rise = (turning(state, outputs) * up[..., None, :]).sum(axis=-1)
    return (outputs["normal_force"] * rise).sum(axis=-1)


def powers(vehicle, state, outputs, command) -> dict[str, np.ndarray]:
    """What brings energy in (W), and what takes it away; of one record each, or of n (n,).

    slip: of the tire's force along the road at the contact point, less what goes into the spin.
    lever: of the load there, less what goes into the tire's spring; the source has that point on
    the body's z axis, beside the wheel centre in roll. brakes: with the rolling resistance. links:
    of the roll centre, whose load transfer is a force along the struts. contact moments: of the
    road on the turning body and on the spinning wheels.
    """
    rotation, yawed = pose(state), turned_by(state["yaw"])
    radius, spin = outputs["loaded_radius"], state["wheel_speed"]
    # along axes of frame 2
    contact = unsprung(vehicle, state) + turning(state, outputs)
    contact = contact @ rotation.swapaxes(-1, -2) @ yawed
    load, struts = outputs["normal_force"], outputs["suspension_rate"]
    slip = outputs["longitudinal_force"] * contact[..., 0]
    slip += outputs["lateral_force"] * contact[..., 1]
    slip -= radius * outputs["tire_longitudinal"] * spin
    moments = couples(state, outputs)
    rates = np.stack([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]], axis=-1)
    turned = (rotation @ rates[..., None])[..., 0]
    rise = spin_axes(vehicle, state, outputs)
    about_axes = outputs["rolling_resistance_moment"] * np.sqrt(1.0 - rise**2)
    about_axes += outputs["aligning_moment"] * rise
    friction = command["brake_torque"] + vehicle.rolling_resistance_coefficient * load * radius
    return {
        "dampers": -(struts**2) @ vehicle.per_wheel("damping"),
        "slip": slip.sum(axis=-1),
        "lever": power_of_lever(state, outputs),
        "brakes": -(np.maximum(friction, 0.0) * np.abs(spin)).sum(axis=-1),
        "drag": -drag(vehicle, state) * state["u"],
        "torques": (command["wheel_torque"] * spin).sum(axis=-1),
        "active": -(command["normal_force"] * struts).sum(axis=-1),
        "contact moments": (moments.sum(axis=-2) * turned).sum(-1) + (about_axes * spin).sum(-1),
        "links": -(outputs["link_load_transfer"] * struts).sum(axis=-1),
    }
