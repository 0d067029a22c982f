"""The body on the ground, written down a second time: corners, forces and states of its tests."""

import numpy as np
from random_states import attitude, random_state, wheel_centres

from vehicle_roll_sim import Options, Vehicle
from vehicle_roll_sim.simulation.road import Road

EXACT = Options(no_roll_centre=True, euler_terms=True, body_contact=True)
GUIDED = Options(model="2", body_contact=True)
STICKING_SPEED = 0.1
"""m/s"""
BOX = {
    "body_front_overhang": 0.7,
    "body_rear_overhang": 1.1,
    "body_width": 1.9,
    "body_roof_height": 1.7,
    "body_floor_height": 0.3,
    "body_stiffness": 3e5,
    "body_damping": 8e3,
    "body_friction": 0.6,
}
"""Values of the parameters of the body, no two alike."""


def corners(vehicle: Vehicle) -> np.ndarray:
    """Of the box in frame 1, floor first, each lf, rf, lr, rr; shape (8, 3) (m)."""
    ahead = vehicle.cg_to_front_axle + vehicle.body_front_overhang
    behind = -vehicle.cg_to_rear_axle - vehicle.body_rear_overhang
    aside, offset = vehicle.body_width / 2, vehicle.cg_offset or 0.0
    return np.array(
        [
            (x, y - offset, height - vehicle.cg_height)
            for height in (vehicle.body_floor_height, vehicle.body_roof_height)
            for x in (ahead, behind)
            for y in (aside, -aside)
        ]
    )


def forces_on_corners(vehicle: Vehicle, road: Road, state) -> tuple[np.ndarray, ...]:
    """Forces on the corners, the places that they act at, and the velocities of these, over the
    ground, each of shape (8, 3); and the normal loads (8,)."""
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    turning = rotation @ [state["roll_rate"], state["pitch_rate"], state["yaw_rate"]]
    arms = corners(vehicle) @ rotation.T
    places = np.array([state["x"], state["y"], state["z"]]) + arms
    velocities = rotation @ [state["u"], state["v"], state["w"]] + np.cross(turning, arms)
    forces, loads = np.zeros((8, 3)), np.zeros(8)
    for k, (place, velocity) in enumerate(zip(places, velocities, strict=True)):
        height, along, across, friction = road.surface(*place[:2])
        normal = np.array([-along, -across, 1.0]) / np.sqrt(1.0 + along**2 + across**2)
        depth = (height - place[2]) * normal[2]
        if depth <= 0.0:
            continue
        pressed = vehicle.body_stiffness * depth - vehicle.body_damping * (velocity @ normal)
        loads[k] = max(pressed, 0.0)
        sliding = velocity - (velocity @ normal) * normal
        speed = np.linalg.norm(sliding)
        share = min(speed / STICKING_SPEED, 1.0) / speed if speed else 0.0
        rubbing = vehicle.body_friction * friction * loads[k] * share
        forces[k] = loads[k] * normal - rubbing * sliding
    return forces, places, velocities, loads


def fallen_state(vehicle: Vehicle, rng: np.random.Generator):
    """A random STATE record at any roll angle with at least one corner in the ground.

    Its wheels are less than 44 degrees from upright, or off the ground: on the way to a disc, a
    load is not that of the energy of a spring.
    """
    while True:
        state = random_state(vehicle, rng)
        state["roll"], state["pitch"] = rng.uniform(-7.0, 7.0), rng.uniform(-0.3, 0.3)
        rotation = attitude(state["roll"], state["pitch"], 0.0)
        state["z"] = rng.uniform(-0.2, 0.0) - (corners(vehicle) @ rotation[2]).min()
        heights = wheel_centres(vehicle, state)[:, 2]
        state["tire_compression"] = vehicle.per_wheel("tire_radius") - heights
        is_upright = rotation[2, 2] > np.cos(np.radians(44.0))
        if is_upright or (heights > vehicle.per_wheel("tire_radius").max()).all():
            return state
