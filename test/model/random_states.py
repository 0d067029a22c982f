"""Random states that a vehicle can reach, for checks that need no history."""

import functools

import numpy as np

from vehicle_roll_sim import Vehicle
from vehicle_roll_sim.model.records import COMMAND, STATE

SPREAD = {
    "x": 50.0,
    "y": 50.0,
    "roll": 1.2,
    "pitch": 0.5,
    "yaw": 3.0,
    "v": 5.0,
    "w": 2.0,
    "roll_rate": 2.0,
    "pitch_rate": 1.0,
    "yaw_rate": 1.5,
    "unsprung_velocity": 3.0,
}
"""Largest magnitude of the states that are drawn uniformly about 0."""
OTHER_SIDE = [1, 0, 3, 2]
REVERSED = {"y", "roll", "yaw", "v", "roll_rate", "yaw_rate", "lateral_slip"}


def wheel_positions(vehicle: Vehicle) -> np.ndarray:
    """(x, y) of every strut in the body (m), one row per wheel."""
    a, b = vehicle.cg_to_front_axle, vehicle.cg_to_rear_axle
    f, r, aside = vehicle.front_track / 2, vehicle.rear_track / 2, vehicle.cg_offset or 0.0
    return np.array([[a, f - aside], [a, -f - aside], [-b, r - aside], [-b, -r - aside]])


def inertia_tensor(vehicle: Vehicle) -> np.ndarray:
    """The sprung mass's, about its c.g. along the body's axes, shape (3, 3) (kg m^2)."""
    products = (vehicle.roll_pitch_product, vehicle.roll_yaw_product, vehicle.pitch_yaw_product)
    xy, xz, yz = (value or 0.0 for value in products)
    x, y, z = vehicle.roll_inertia, vehicle.pitch_inertia, vehicle.yaw_inertia
    return np.array([[x, -xy, -xz], [-xy, y, -yz], [-xz, -yz, z]])


@functools.lru_cache(16, typed=True)  # 0 is not 0j; an audit asks for one several times
def attitude(roll, pitch, yaw) -> np.ndarray:
    """Rz(yaw) Ry(pitch) Rx(roll), also of complex angles: body to ground. Read only."""
    rotation = attitudes(roll, pitch, yaw)
    rotation.flags.writeable = False
    return rotation


def attitudes(roll, pitch, yaw) -> np.ndarray:
    """The same of arrays of angles of one shape, shape (..., 3, 3)."""
    (sr, sp, sy), (cr, cp, cy) = np.sin([roll, pitch, yaw]), np.cos([roll, pitch, yaw])
    no, one = np.zeros_like(sr), np.ones_like(sr)
    about_z = np.array([[cy, -sy, no], [sy, cy, no], [no, no, one]])
    about_y = np.array([[cp, no, sp], [no, one, no], [-sp, no, cp]])
    about_x = np.array([[one, no, no], [no, cr, -sr], [no, sr, cr]])
    z, y, x = (np.moveaxis(each, (0, 1), (-2, -1)) for each in (about_z, about_y, about_x))
    return z @ y @ x


def random_state(vehicle: Vehicle, rng: np.random.Generator) -> np.ndarray:
    """A STATE record with wheels at, below or above the road level, consistent with the body."""
    state = np.zeros(1, STATE)[0]
    for name, largest in SPREAD.items():
        state[name] = rng.uniform(-largest, largest, STATE[name].shape)
    state["u"] = rng.uniform(5.0, 30.0)
    state["z"] = vehicle.cg_height + rng.uniform(-0.1, 0.3)
    state["suspension_compression"] = rng.uniform(-0.1, 0.3, 4)
    state["wheel_speed"] = state["u"] / vehicle.tire_radius * rng.uniform(0.7, 1.3, 4)
    heights = wheel_centres(vehicle, state)[:, 2]
    state["tire_compression"] = vehicle.tire_radius - heights
    state["longitudinal_slip"] = rng.uniform(-0.3, 0.3, 4)
    state["lateral_slip"] = rng.uniform(-0.5, 0.5, 4)
    return state


def random_command(rng: np.random.Generator) -> np.ndarray:
    """A COMMAND record of steering, torques and active forces."""
    command = np.zeros(1, COMMAND)[0]
    command["steering"], command["rear_steering"] = rng.uniform(-0.5, 0.5, 2)
    command["wheel_torque"] = rng.uniform(-3000.0, 3000.0, 4)
    command["normal_force"] = rng.uniform(-5000.0, 5000.0, 4)
    return command


def strut_lengths(vehicle: Vehicle, compression: np.ndarray) -> np.ndarray:
    """Distance from the plane of the sprung c.g. down to each wheel centre (m)."""
    return vehicle.static_strut_length - (compression - vehicle.static_suspension_compression)


def wheel_centres(vehicle: Vehicle, state) -> np.ndarray:
    """Positions of the wheel centres in the ground frame (m), one row each; also complex."""
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    lengths = strut_lengths(vehicle, state["suspension_compression"])
    in_body = np.column_stack([wheel_positions(vehicle), -lengths])
    return np.array([state["x"], state["y"], state["z"]]) + in_body @ rotation.T


def mirrored(record) -> np.ndarray:
    """A STATE or COMMAND record seen in a mirror."""
    other = record.copy()
    for name in record.dtype.names:
        value = record[name][OTHER_SIDE] if record.dtype[name].shape == (4,) else record[name]
        other[name] = -value if name in (*REVERSED, "steering", "rear_steering") else value
    if "wind" in record.dtype.names:
        other["wind"][1] = -record["wind"][1]
    return other
