"""Dynamic roll-plane model: the body rolls about the roll axis, all wheels stay on the ground.

J roll'' = m h (f + g roll) - K roll - C roll', where f is the lateral tire force per mass of the
whole vehicle, m h the first moment of the sprung mass about the roll axis (eq. 81), and K and C are
the roll stiffness and damping of springs and tires in series. The axis can move laterally with the
tire forces, so J is smaller than about a fixed axis: Jx + m mu / (m + mu) h^2, with the unsprung
mass mu.
"""

import numpy as np

from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.records import OPTIONS, WHEEL_COUNT
from vehicle_roll_sim.model.roll_axis import corner_damping, roll_stiffness, wheel_centre_height
from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.model.suspension.links import half_track


class RollPlaneMotion(RollPlane):
    """Roll acceleration and load transfer of the rolling body; SI units and radians.

    vehicle: an array of one VEHICLE record (`Vehicle.record()`).
    """

    def __init__(self, vehicle: np.ndarray):
        super().__init__(vehicle)
        car, options = (kernel_argument(part)[0] for part in (vehicle, np.zeros(1, OPTIONS)))
        wheels = range(WHEEL_COUNT)
        self._stiffness = float(roll_stiffness(car, options))
        damping = [half_track(i, car) ** 2 * corner_damping(i, car, options) for i in wheels]
        self._damping = float(sum(damping))
        self._roll_inertia = float(car.roll_inertia)
        self._mass = self.weight / self._gravity
        self._moment = self._sprung_mass * self._depth
        share = 1.0 - self._sprung_mass / self._mass
        self._axis_follows = share * self._depth
        heights = np.mean([wheel_centre_height(i, car) for i in wheels])
        lever = float(vehicle[0]["cg_height"] - heights)
        self._axis_lever = self._sprung_mass * share * self._depth * lever

    def tire_force(self, roll: float, roll_rate: float, lateral_acceleration: float) -> float:
        """Lateral tire force per vehicle mass (m/s^2), from signals measured at the sprung c.g.

        roll: rad. roll_rate: rad/s. lateral_acceleration: of the sprung c.g. (m/s^2).
        """
        moment = self._moment_about_axis(roll, roll_rate, lateral_acceleration)
        return lateral_acceleration + self._axis_follows * moment / self._roll_inertia

    def roll_acceleration(self, roll: float, roll_rate: float, force: float) -> float:
        """Roll acceleration (rad/s^2) at a lateral tire force per vehicle mass (m/s^2)."""
        inertia = self._roll_inertia + self._moment * self._axis_follows
        return self._moment_about_axis(roll, roll_rate, force) / inertia

    def _moment_about_axis(self, roll: float, roll_rate: float, acceleration: float) -> float:
        tipping = self._moment * (acceleration + self._gravity * roll)
        return tipping - self._stiffness * roll - self._damping * roll_rate

    def load_transfer_ratio_of(self, roll: float, roll_acceleration: float, force: float) -> float:
        """(right - left) / total of the normal loads; a magnitude above 1 means lift-off.

        roll: rad. roll_acceleration: rad/s^2. force: lateral tire force per vehicle mass (m/s^2).
        """
        overturning = self._mass * self.cg_height * force + self._moment * self._gravity * roll
        inertia = self._roll_inertia + self._axis_lever
        moment = overturning - inertia * roll_acceleration
        return 2 * moment / (self.weight * self.track)
