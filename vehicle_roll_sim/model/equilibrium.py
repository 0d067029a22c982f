"""Static equilibrium: compressions at rest, and the initial state of a run."""

import numpy as np

from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.records import LR, STATE, WHEEL_COUNT
from vehicle_roll_sim.model.tire.radii import effective_rolling_radius

ROUNDS = 30
"""Iterations for the rolling radius and the spin, on which it depends a little."""


def axle_load_share(to_front: float, to_rear: float) -> np.ndarray:
    """Share of the sprung weight on each wheel, shape (4,); the sum is 1.

    to_front, to_rear: distances from the c.g. to the axles (m).
    """
    wheelbase = to_front + to_rear
    front, rear = to_rear / (2 * wheelbase), to_front / (2 * wheelbase)
    return np.array([front, front, rear, rear])


def static_suspension_compression(sprung_mass, share, spring_stiffness, gravity) -> np.ndarray:
    """xsi of each corner (m; eq. 19 with the factor g that the paper omits)."""
    return sprung_mass * gravity * share / spring_stiffness


def static_tire_compression(
    sprung_mass, share, unsprung_mass, tire_stiffness, gravity
) -> np.ndarray:
    """xti of each tire (m; eq. 20 with the factor g that the paper omits)."""
    return (sprung_mass * share + unsprung_mass) * gravity / tire_stiffness


def static_strut_length(cg_height, tire_radius, tire_compression) -> np.ndarray:
    """lsi of each corner (m; eq. 18)."""
    return cg_height - (tire_radius - tire_compression)


def equilibrium(vehicle: np.ndarray, tires: np.ndarray, speed: float) -> np.ndarray:
    """The state of free rolling straight ahead at `speed` (m/s): an array of one STATE record.

    vehicle, tires: VEHICLE (1,) and TIRE (2,) records.
    """
    state = np.zeros(1, STATE)
    car, start = vehicle[0], state[0]
    start.z = car.cg_height
    start.u = speed
    start.suspension_compression = car.static_suspension_compression
    start.tire_compression = car.static_tire_compression
    start.wheel_speed = np.full(WHEEL_COUNT, speed) / rolling_radius(car, tires, speed)
    return state


def rolling_radius(car: np.record, tires: np.ndarray, speed: float) -> np.ndarray:
    """Rolling radius of each tire at its static load and a speed (m/s); shape (4,) (m)."""
    radius = car.tire_radius - car.static_tire_compression
    loads = car.tire_stiffness * car.static_tire_compression
    for axle, tire in enumerate(kernel_argument(tires)):
        if tire.rolls_on_own_radius:
            wheel = LR * axle
            load, effective = float(loads[wheel]), float(radius[wheel])
            for _ in range(ROUNDS):
                effective = effective_rolling_radius(load, speed / effective, tire)
            radius[wheel : wheel + LR] = effective
    return radius
