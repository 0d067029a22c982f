"""Rear steering in phase with the front reduces the lateral acceleration.

The rear wheels are steered by `gain` times the yaw rate, in the same direction as the front wheels.
The rear tires then build up their lateral force with less body sideslip, and the yaw rate and the
lateral acceleration stay smaller.
"""

import dataclasses

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.runs.control_law import ControlLaw, Sensed


@dataclasses.dataclass(kw_only=True)
class RearSteering(ControlLaw):
    """The road-wheel angle of the rear axle."""

    commands = ("rear_steering",)

    gain: float = parameter("rear angle per yaw rate", "s", -10.0, 10.0, default=0.12)
    largest_angle: float = parameter("largest rear angle", "rad", 0.0, 1.0, default=0.1)

    def answer(self, sensed: Sensed) -> dict:
        return {"rear_steering": self.angle(float(sensed.state["yaw_rate"]))}

    def angle(self, yaw_rate: float) -> float:
        """The rear road-wheel angle (rad, left positive) at a yaw rate (rad/s)."""
        return max(-self.largest_angle, min(self.largest_angle, self.gain * yaw_rate))
