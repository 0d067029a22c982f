"""Static equilibrium: compressions at rest, and the initial state of a run."""

import numpy as np

from vehicle_roll_sim.model.records import FRONT, LR, REAR, STATE, WHEEL_COUNT
from vehicle_roll_sim.model.tire.radii import free_spin

AT_REST = (
    *("cg_height", "static_suspension_compression", "static_tire_compression"),
    *("tire_radius", "tire_stiffness", "tire_progression", "camber", "static_loaded_radius"),
)
"""Fields of VEHICLE on which the equilibrium depends."""


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
    sprung_mass, share, unsprung_mass, tire_stiffness, progression, gravity
) -> np.ndarray:
    """xti of each tire (m; eq. 20 with the factor g that the paper omits); see `tire.spring`."""
    load = (sprung_mass * share + unsprung_mass) * gravity
    return progressive_compression(load / tire_stiffness, progression)


def progressive_compression(linear, progression) -> np.ndarray:
    """Compression x of each tire (m) from x (1 + p x), its load over its stiffness (m).

    linear: the latter, which is the compression without progression, also where it is negative, as
    in `tire.spring`. progression: p (1/m).
    """
    return 2 * linear / (1.0 + np.sqrt(1.0 + 4 * progression * np.maximum(linear, 0.0)))


def static_tire_load(compression, tire_stiffness, progression) -> np.ndarray:
    """Load of each tire at its compression at rest, shape (4,) (N)."""
    return compression * tire_stiffness * (1.0 + progression * compression)


def static_strut_length(cg_height, tire_radius, tire_compression) -> np.ndarray:
    """lsi of each corner (m; eq. 18)."""
    return cg_height - (tire_radius - tire_compression)


def equilibrium(
    vehicle: np.ndarray, tires: np.ndarray, speed: float, *, is_kinematic: bool
) -> np.ndarray:
    """The state of free rolling straight ahead at `speed` (m/s): an array of one STATE record.

    vehicle: VEHICLE, shape (1,). tires: TIRE, of front and rear axle, shape (2,). is_kinematic:
    whether it is that of model 2, where leaning wheels have their loaded radius along their plane.
    """
    state = np.zeros(1, STATE)
    car = {name: vehicle[name][0] for name in AT_REST}
    compression = car["static_tire_compression"]
    state["z"], state["u"] = car["cg_height"], speed
    state["suspension_compression"] = car["static_suspension_compression"]
    state["tire_compression"] = compression
    radius = car["tire_radius"] - compression
    if is_kinematic:
        radius = np.where(car["camber"] != 0.0, car["static_loaded_radius"], radius)
    speeds = np.full(WHEEL_COUNT, speed) / radius
    load = static_tire_load(compression, car["tire_stiffness"], car["tire_progression"])
    for i in range(WHEEL_COUNT):
        tire = tires[FRONT if i < LR else REAR]
        if tire["rolls_on_own_radius"]:
            speeds[i] = free_spin(speed, load[i], tire)
    state["wheel_speed"] = speeds
    return state
