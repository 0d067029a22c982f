"""Forces, moments and radii of a tire at given loads and slips, without a vehicle."""

from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.compiled.jit import kernel_argument, silently
from vehicle_roll_sim.model.records import LF, OUTPUTS, RF, WHEEL_COUNT
from vehicle_roll_sim.model.tire.coefficients import as_one, on_axles
from vehicle_roll_sim.model.tire.magic_formula import tire_forces
from vehicle_roll_sim.model.tire.radii import radii_at
from vehicle_roll_sim.vehicle.tire_file import Tire

REFERENCE_SPEED = 16.7
"""m/s: speed of the evaluation if the tire file gives no LONGVL."""
WHEELS = {"left": LF, "right": RF}
FORCES = (
    *("tire_longitudinal", "tire_lateral"),
    *("overturning_moment", "rolling_resistance_moment", "aligning_moment"),
)
"""The forces and moments among OUTPUTS."""
BLOCK = 100 * WHEEL_COUNT
"""Points whose forces are found in one call of compiled code: its work space takes 1 MB."""


class TireForces(NamedTuple):
    """Arrays of one shape: forces (N), moments (N m) and radii (m), in the axes of the contact
    patch (ISO-W); nan if the version or the file does not define the quantity."""

    longitudinal_force: np.ndarray
    lateral_force: np.ndarray
    overturning_moment: np.ndarray
    rolling_resistance_moment: np.ndarray
    aligning_moment: np.ndarray
    loaded_radius: np.ndarray
    effective_rolling_radius: np.ndarray


def evaluate(
    tire: Tire,
    normal_force,
    slip_ratio,
    slip_angle,
    inclination=0.0,
    pressure: float | None = None,
    speed: float | None = None,
    side: str = "left",
    *,
    as_published: bool = False,
) -> TireForces:
    """Evaluate a tire at loads (N), slip ratios, slip angles and inclinations (rad).

    These are numbers or arrays that are broadcast together with `speed`, the speed of the contact
    patch along the wheel (m/s), by default LONGVL of the file. pressure: inflation pressure (Pa),
    by default that of the file. side: of the vehicle, left or right. as_published: allow negative
    weights of combined slip, as in the published equations, for comparison with other
    implementations; in the simulation they never reverse a force.

    Raises InputError for any other side, and for a pressure if the tire does not depend on it.
    """
    if side not in WHEELS:
        raise InputError("side", side, " or ".join(WHEELS))
    speed = tire.coefficients.get("LONGVL") or REFERENCE_SPEED if speed is None else speed
    given = (normal_force, slip_ratio, slip_angle, inclination, speed)
    given = np.broadcast_arrays(*(np.asarray(each, float) for each in given))
    shape, points = given[0].shape, np.column_stack([each.ravel() for each in given])
    record, radii = tire.record(pressure, moments=True), np.empty((len(points), 2))
    wheel_side = float(record["side"][0, WHEELS[side]])
    if as_published:
        record["lowest_weight"] = -np.inf
    with silently():
        blocks = range(0, len(points), BLOCK)
        rows = [_forces(record, points[at : at + BLOCK], wheel_side) for at in blocks]
        forces = np.concatenate((*rows, np.empty((0, len(FORCES)))))
        radii_at(points, forces, kernel_argument(record), wheel_side, radii)
    return TireForces(*(column.reshape(shape) for column in (*forces.T, *radii.T)))


def _forces(record: np.ndarray, points: np.ndarray, side: float) -> np.ndarray:
    """Forces and moments, shape (n, 5), at points (n, 5); each four are the wheels of a vehicle."""
    count = -(-len(points) // WHEEL_COUNT)
    fields = np.zeros((count * WHEEL_COUNT, points.shape[1]))
    fields[: len(points)] = points
    load, ratio, angle, inclination, speed = fields.T.reshape(-1, count, WHEEL_COUNT)
    outputs = np.zeros(count, OUTPUTS)
    outputs["normal_force"], outputs["slip_ratio"] = load, ratio
    outputs["slip_tangent"], outputs["inclination"] = np.tan(angle), inclination
    outputs["rolling"], outputs["tread"] = speed, speed + ratio * np.abs(speed)
    outputs["side"], outputs["road_friction"] = side, 1.0
    tire_forces(kernel_argument(as_one(on_axles(record, record))), kernel_argument(outputs))
    return np.column_stack([outputs[name].ravel() for name in FORCES])[: len(points)]
