"""Forces, moments and radii of a tire at given loads and slips, without a vehicle."""

from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.compiled.jit import kernel_argument, silently
from vehicle_roll_sim.model.records import LF, OUTPUTS, RF, WHEEL_COUNT
from vehicle_roll_sim.model.tire.coefficients import as_one, on_axles
from vehicle_roll_sim.model.tire.magic_formula import tire_forces
from vehicle_roll_sim.model.tire.radii import effective_rolling_radius, free_spin, loaded_radius
from vehicle_roll_sim.vehicle.tire_file import Tire

REFERENCE_SPEED = 16.7
"""m/s: speed of the evaluation if the tire file gives no LONGVL."""
WHEELS = {"left": LF, "right": RF}


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
    shape, points = given[0].shape, np.array([each.ravel() for each in given]).T
    record = tire.record(pressure, moments=True)
    if as_published:
        record["lowest_weight"] = -np.inf
    with silently():
        rows = _forces(record, points, WHEELS[side])
        radii = [
            _radii(record, point, row, WHEELS[side])
            for point, row in zip(points, rows, strict=True)
        ]
    columns = np.column_stack((rows, np.reshape(radii, (-1, 2)))).T
    return TireForces(*(column.reshape(shape) for column in columns))


def _forces(record: np.ndarray, points: np.ndarray, wheel: int) -> np.ndarray:
    """Forces and moments, shape (n, 5), at points (n, 5); every batch is one of four wheels."""
    (tires,), outputs = kernel_argument(as_one(on_axles(record, record))), np.zeros(1, OUTPUTS)
    found, seen = np.empty((len(points), 5)), outputs[0]
    for first in range(0, len(points), WHEEL_COUNT):
        batch = points[first : first + WHEEL_COUNT]
        fields = np.zeros((5, WHEEL_COUNT))
        fields[:, : len(batch)] = batch.T
        load, ratio, angle, inclination, speed = fields
        outputs["normal_force"], outputs["slip_ratio"] = load, ratio
        outputs["slip_tangent"], outputs["inclination"] = np.tan(angle), inclination
        outputs["rolling"], outputs["tread"] = speed, speed + ratio * np.abs(speed)
        outputs["side"], outputs["road_friction"] = record["side"][0, wheel], 1.0
        tire_forces(tires, kernel_argument(outputs)[0])
        rows = (
            *(seen.tire_longitudinal, seen.tire_lateral, seen.overturning_moment),
            *(seen.rolling_resistance_moment, seen.aligning_moment),
        )
        found[first : first + len(batch)] = np.transpose(rows)[: len(batch)]
    return found


def _radii(record: np.ndarray, point: np.ndarray, forces: np.ndarray, wheel: int) -> tuple:
    """Loaded and effective rolling radius (m) at a point; nan where the file has none.

    Off the ground the loaded radius is that of the free tire.
    """
    (tire,), side = kernel_argument(record), record["side"][0, wheel]
    load, ratio, _, inclination, speed = (float(each) for each in point)
    if not (tire.VERTICAL_STIFFNESS > 0.0 and tire.UNLOADED_RADIUS > 0.0 and tire.LONGVL > 0.0):
        return np.nan, np.nan
    spin = free_spin((1 + ratio) * speed, load, tire)
    rolling = effective_rolling_radius(load, spin, tire)
    effective = rolling if tire.rolls_on_own_radius else np.nan
    if tire.version < 6.0:
        return np.nan, effective
    gamma, fx, fy = side * inclination, forces[0], side * forces[1]
    return loaded_radius(max(load, 0.0), spin, gamma, float(fx), float(fy), tire), effective
