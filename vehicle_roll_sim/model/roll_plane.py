"""Roll-plane models: the simplest predictors of lift-off, in steady cornering.

Rigid: the whole vehicle is one body on two wheels; the threshold is the static stability factor.
Suspended, quasi-static: the sprung mass rolls about the roll axis (eq. 81) on springs and tires in
series, and its c.g. moves outwards.
"""

import numpy as np

from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.records import OPTIONS
from vehicle_roll_sim.model.roll_axis import roll_axis_depth, roll_stiffness


class RollPlane:
    """A roll-plane model of one vehicle.

    vehicle: an array of one VEHICLE record (`Vehicle.record()`). suspended: False for the rigid
    model. Attributes: `weight` of the whole vehicle (N), `track`, mean track width (m), `cg_height`
    of the whole vehicle (m), `static_stability_factor` (-), and `roll_gradient` (rad/(m/s^2)),
    which is 0 for the rigid model and inf if the springs cannot hold the body upright.
    """

    def __init__(self, vehicle: np.ndarray, suspended: bool = True):
        car = vehicle[0]
        unsprung = car["unsprung_mass"]
        mass = car["sprung_mass"] + unsprung.sum()
        wheel_centres = car["tire_radius"] - car["static_tire_compression"]
        moment = car["sprung_mass"] * car["cg_height"] + (unsprung * wheel_centres).sum()
        self.cg_height = float(moment / mass)
        self.weight = float(mass * car["gravity"])
        self.track = float(2 * np.abs(car["y"]).mean())
        self.static_stability_factor = self.track / (2 * self.cg_height)
        self._gravity = float(car["gravity"])
        self._depth = float(roll_axis_depth(kernel_argument(vehicle)[0]))
        self._sprung_mass = float(car["sprung_mass"])
        self.roll_gradient = self._gradient(vehicle) if suspended else 0.0

    def _gradient(self, vehicle: np.ndarray) -> float:
        springs = (kernel_argument(part)[0] for part in (vehicle, np.zeros(1, OPTIONS)))
        tipping = self._sprung_mass * self._depth
        left_over = roll_stiffness(*springs) - tipping * self._gravity
        return float(tipping / left_over) if left_over > 0.0 else np.inf

    @property
    def _overturning_arm(self) -> float:
        """Overturning moment per vehicle weight and per g of lateral acceleration (m)."""
        outward = self._sprung_mass * self._depth * self.roll_gradient
        return self.cg_height + outward * self._gravity**2 / self.weight

    @property
    def lift_off_threshold(self) -> float:
        """Lateral acceleration (m/s^2) at which the inner wheels lift off."""
        return self._gravity * self.track / (2 * self._overturning_arm)

    def roll(self, lateral_acceleration):
        """Roll angle (rad) at a lateral acceleration (m/s^2), both of any shape."""
        return self.roll_gradient * np.asarray(lateral_acceleration)

    def load_transfer_ratio(self, lateral_acceleration):
        """(right - left) / total of the loads, -1 to 1, at a lateral acceleration (m/s^2)."""
        share = np.asarray(lateral_acceleration) / self.lift_off_threshold
        return np.clip(share, -1.0, 1.0)
