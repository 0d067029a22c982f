"""The suspended roll-plane model in motion: the body swings about the roll axis, wheels stay down.

J roll'' = m h (f + g roll) - K roll - C roll', where f is the lateral force of the tires per mass
of the whole vehicle, m h the moment of the sprung mass about the roll axis (eq. 81), K and C
stiffness and damping of springs and tires in series. The axis follows the tires' forces sideways,
so that J is less than about a fixed axis: Jx + m mu / (m + mu) h^2, with the unsprung mass mu.
"""

import numpy as np

from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.records import OPTIONS, WHEEL_COUNT
from vehicle_roll_sim.model.roll_axis import corner_damping, roll_stiffness, wheel_centre_height
from vehicle_roll_sim.model.roll_plane import RollPlane


class RollPlaneMotion(RollPlane):
    """Roll acceleration and load transfer of a rolling body; all angles in rad, SI units.

    vehicle: one VEHICLE record in an array (`Vehicle.record()`).
    """

    def __init__(self, vehicle: np.ndarray):
        super().__init__(vehicle)
        car, options = (kernel_argument(part)[0] for part in (vehicle, np.zeros(1, OPTIONS)))
        wheels = range(WHEEL_COUNT)
        self._stiffness = float(roll_stiffness(car, options))
        self._damping = float(sum(car.y[i] ** 2 * corner_damping(i, car, options) for i in wheels))
        self._roll_inertia = float(car.roll_inertia)
        self._mass = self.weight / self._gravity
        self._moment = self._sprung_mass * self._depth
        share = 1.0 - self._sprung_mass / self._mass
        self._axis_follows = share * self._depth
        heights = np.mean([wheel_centre_height(i, car) for i in wheels])
        lever = float(vehicle[0]["cg_height"] - heights)
        self._axis_lever = self._sprung_mass * share * self._depth * lever

    def tire_force(self, roll: float, roll_rate: float, lateral_acceleration: float) -> float:
        """Lateral force of the tires per mass (m/s^2), from what the sprung c.g. measures."""
        moment = self._moment_about_axis(roll, roll_rate, lateral_acceleration)
        return lateral_acceleration + self._axis_follows * moment / self._roll_inertia

    def roll_acceleration(self, roll: float, roll_rate: float, force: float) -> float:
        """rad/s^2 at a lateral force of the tires per mass (m/s^2)."""
        inertia = self._roll_inertia + self._moment * self._axis_follows
        return self._moment_about_axis(roll, roll_rate, force) / inertia

    def _moment_about_axis(self, roll: float, roll_rate: float, acceleration: float) -> float:
        tipping = self._moment * (acceleration + self._gravity * roll)
        return tipping - self._stiffness * roll - self._damping * roll_rate

    def load_transfer_ratio_of(self, roll: float, roll_acceleration: float, force: float) -> float:
        """(right - left) / total of the loads; beyond 1 the inner wheels cannot stay down."""
        overturning = self._mass * self.cg_height * force + self._moment * self._gravity * roll
        inertia = self._roll_inertia + self._axis_lever
        moment = overturning - inertia * roll_acceleration
        return 2 * moment / (self.weight * self.track)
