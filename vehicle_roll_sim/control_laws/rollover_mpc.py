"""Model-predictive rollover prevention by braking of the front wheels and by rear steering.

Every period, the inputs of the next BLOCKS intervals are chosen that keep the predicted load
transfer ratio within `ratio_limit` with as little intervention as possible. With x, the inputs over
their largest values, they minimize

    |x|^2 + change_weight |x - x before|^2 + ratio_weight sum of max(0, |ratio| - ratio_limit)^2

over all steps of the prediction, within the bounds of the inputs; the first block is applied. The
problem is solved by
Gauss-Newton steps, each of which minimizes a quadratic within bounds; the number of iterations is
fixed, so that the result is the same on every run, and they start from the last solution.
"""

import dataclasses
from collections.abc import Mapping

import numpy as np

from vehicle_roll_sim.control_laws.motion_law import MotionLaw
from vehicle_roll_sim.control_laws.prediction import Inputs, PredictionModel
from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

INPUT_COUNT = len(Inputs._fields)
BLOCKS = 4
"""Equal intervals of the horizon in each of which the inputs are constant."""
ITERATIONS = 1
"""Gauss-Newton steps in a period: the plan of the last period is a good start."""
SLIGHT = 1e-3
"""Change of an input, over its largest value, for a difference quotient."""
FRACTIONS = np.array([1.0, 0.5, 0.25, 0.0])
"""Shares of a Gauss-Newton step that are tried."""
NOTHING = 1e-4
"""Inputs below this share of their largest values are set to 0, so that an intervention ends."""
SWEEPS = 20
"""Sweeps of the solver of the quadratic problem over all inputs."""
SLOWEST = 3.0
"""m/s: below, the controller does nothing."""


@dataclasses.dataclass(kw_only=True)
class RolloverMpc(MotionLaw):
    """The predictive controller.

    `begin` makes the prediction model of the vehicle, `model`. Tire pressures are not part of it.
    """

    commands = ("rear_steering", "brake_torque")

    horizon: float = parameter(
        "prediction horizon, in 4 blocks of whole time steps", "s", 0.01, 10.0, default=0.6
    )
    interval: float = parameter("time step of the prediction", "s", 1e-3, 0.1, default=0.03)
    ratio_limit: float = parameter("load transfer ratio to be kept", "", 0.0, 1.0, default=0.8)
    ratio_weight: float = parameter(
        "weight of a step beyond that ratio", "", 0.0, 1e9, default=200.0
    )
    change_weight: float = parameter(
        "weight of changes from the inputs of the last period", "", 0.0, 1e6, default=0.2
    )
    largest_rear_steering: float = parameter(
        "largest rear road-wheel angle", "rad", 1e-6, 1.0, default=0.06
    )
    largest_brake_use: float = parameter(
        "largest brake force of a front wheel over its grip at rest", "", 1e-6, 2.0, default=1.2
    )

    def begin(self, vehicle: Vehicle, options: Options) -> None:
        self.model = PredictionModel(vehicle, self.interval)
        per_block = round(self.horizon / BLOCKS / self.interval)
        self._block_of_step = np.repeat(np.arange(BLOCKS), max(per_block, 1))
        brake = self.largest_brake_use * self.model.front_grip
        self._largest = np.array([self.largest_rear_steering, brake, brake])
        self._lower = np.tile([-1.0, 0.0, 0.0], BLOCKS)
        self._upper = np.ones_like(self._lower)
        super().begin(vehicle, options)

    def restart(self) -> None:
        super().restart()
        self._planned = np.zeros_like(self._lower)

    def commanded(self, motion: Mapping[str, float]) -> dict:
        if motion["u"] < SLOWEST:
            self._planned = np.zeros_like(self._lower)
            return {"rear_steering": 0.0, "brake_torque": (0.0,) * WHEEL_COUNT}
        self._planned = self.plan(motion)
        angle, *forces = (self._largest * self._planned[:INPUT_COUNT]).tolist()
        left, right = (force * self.model.front_radius for force in forces)
        return {"rear_steering": angle, "brake_torque": (left, right, 0.0, 0.0)}

    def plan(self, motion: Mapping[str, float]) -> np.ndarray:
        """Inputs over their largest values for every block, shape (3 BLOCKS,)."""
        before, plan = self._planned, self._planned
        for _ in range(ITERATIONS):
            changes = np.vstack((np.zeros_like(plan), SLIGHT * np.eye(len(plan))))
            now, *moved = self.residuals(motion, plan + changes, before)
            if not now.any():
                return plan
            slopes = np.transpose([(each - now) / SLIGHT for each in moved])
            step = smallest_within(slopes, now, self._lower - plan, self._upper - plan)
            tried = plan + FRACTIONS[:, np.newaxis] * step
            costs = (self.residuals(motion, tried, before) ** 2).sum(axis=1)
            plan = tried[costs.argmin()]
            plan[np.abs(plan) < NOTHING] = 0.0
        return plan

    def residuals(
        self, motion: Mapping[str, float], plans: np.ndarray, before: np.ndarray
    ) -> np.ndarray:
        """Residuals whose squares are summed in the cost, a row for each of `plans` (n, 3 BLOCKS).

        before: the plan of the last period.
        """
        ratios = self.model.ratios(motion, self.inputs_of(plans))
        beyond = np.maximum(0.0, np.abs(ratios) - self.ratio_limit).T
        weights = np.sqrt([self.change_weight, self.ratio_weight])
        return np.hstack((plans, weights[0] * (plans - before), weights[1] * beyond))

    def inputs_of(self, plans: np.ndarray) -> list[Inputs]:
        """The inputs of every step of the prediction, for each of `plans`."""
        values = plans.reshape(len(plans), BLOCKS, INPUT_COUNT) * self._largest
        blocks = [Inputs(*values[:, block].T) for block in range(BLOCKS)]
        return [blocks[block] for block in self._block_of_step]


def smallest_within(
    slopes: np.ndarray, residual: np.ndarray, lower: np.ndarray, upper: np.ndarray
) -> np.ndarray:
    """The x within bounds for which |residual + slopes x|^2 is smallest, shape (n,).

    slopes: (m, n) of full rank. residual: (m,). lower <= 0 <= upper: (n,). One coordinate after the
    other is set to its best value (Gauss-Seidel), SWEEPS times; this converges, as the quadratic is
    strictly convex.
    """
    hessian, gradient = slopes.T @ slopes, slopes.T @ residual
    x = np.zeros(len(gradient))
    for _ in range(SWEEPS):
        for k in range(len(x)):
            best = x[k] - (gradient[k] + hessian[k] @ x) / hessian[k, k]
            x[k] = min(max(best, lower[k]), upper[k])
    return x
