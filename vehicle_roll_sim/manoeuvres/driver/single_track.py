"""The linear single-track model of a vehicle: the internal model of the path-following driver."""

import dataclasses
import functools

import numpy as np

from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.records import FRONT, LF, LR, OUTPUTS, REAR, WHEEL_COUNT
from vehicle_roll_sim.model.tire.coefficients import as_one
from vehicle_roll_sim.model.tire.magic_formula import tire_forces
from vehicle_roll_sim.vehicle.parameters import Vehicle

SMALL_SLIP = 1e-4
"""Tangent of the slip angle, of either sign, for the finite difference of the lateral force."""
LATERAL, YAWING = 0, 1
"""Indices of the lateral velocity v and the yaw rate r among the states."""


@dataclasses.dataclass(frozen=True, eq=False)
class SingleTrack:
    """M d(v, r)/dt = (S / u - u T) (v, r) + s delta, about the sprung c.g., in SI units.

    v: lateral velocity (m/s). r: yaw rate (rad/s). u: forward speed (m/s). delta: front road-wheel
    angle (rad). inertia: M (2, 2), unsprung masses included. slip: S (2, 2), from the cornering
    stiffnesses. turning: T (2, 2), whose second column is the first column of M, else 0. steer: s
    (2,). There is no roll: this is the two-degree-of-freedom model of Riekert and Schunck (1940).
    """

    inertia: np.ndarray
    slip: np.ndarray
    turning: np.ndarray
    steer: np.ndarray

    @classmethod
    def of(cls, vehicle: Vehicle) -> "SingleTrack":
        """The model of a vehicle on a level road, with cornering stiffnesses at static load."""
        record = vehicle.record()[0]
        unsprung = record.unsprung_mass
        mass = record.sprung_mass + unsprung.sum()
        offset = (unsprung * record.x).sum()
        turning = record.yaw_inertia + (unsprung * (record.x**2 + record.y**2)).sum()
        inertia = np.array([[mass, offset], [offset, turning]])
        stiffness, arm = cornering_stiffnesses(vehicle), np.array([record.x[LF], record.x[LR]])
        moments = [(stiffness * arm**power).sum() for power in range(3)]
        slip = -np.array([moments[:2], moments[1:]])
        columns = np.column_stack((np.zeros(2), inertia[:, LATERAL]))
        return cls(inertia, slip, columns, stiffness[0] * np.array([1.0, arm[0]]))

    def rates(self, speed: float) -> tuple[np.ndarray, np.ndarray]:
        """A (2, 2) and b (2,) of d(v, r)/dt = A (v, r) + b delta at a forward speed (m/s)."""
        forces = self.slip / speed - speed * self.turning
        return np.linalg.solve(self.inertia, forces), self._steered

    @functools.cached_property
    def _steered(self) -> np.ndarray:
        return np.linalg.solve(self.inertia, self.steer)


def cornering_stiffnesses(vehicle: Vehicle) -> np.ndarray:
    """Cornering stiffnesses (2,) of the front and rear axle, both tires, at static load (N/rad)."""
    tires, side = vehicle.tires(), np.ones(WHEEL_COUNT)
    side[:LR], side[LR:] = tires[FRONT]["side"][:LR], tires[REAR]["side"][LR:]
    loads = vehicle.static_tire_load
    outputs = np.zeros(2, OUTPUTS)
    outputs["side"], outputs["normal_force"], outputs["road_friction"] = side, loads, 1.0
    outputs["slip_tangent"][0], outputs["slip_tangent"][1] = -SMALL_SLIP, SMALL_SLIP
    tire_forces(kernel_argument(as_one(tires)), kernel_argument(outputs))
    left, right = outputs["tire_lateral"]
    slopes = (left - right) / (2 * SMALL_SLIP)
    return np.array([slopes[:LR].sum(), slopes[LR:].sum()])
