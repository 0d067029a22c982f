"""The road: a plane with grade and bank."""

import dataclasses
import math

from vehicle_roll_sim.declaration import keep_validated, parameter

STEEPEST = 1.0
"""m/m: 45 degrees."""


@dataclasses.dataclass(frozen=True)
class Road:
    """A plane whose axes are those of the ground frame: x ahead at the start, y to the left.

    Gravity is turned against it, so that all positions, heights and attitudes are relative to the
    road. Raises InputError for a slope that is no road.
    """

    grade: float = parameter(
        "rise of the road over the distance ahead", "m/m", -STEEPEST, STEEPEST, default=0.0
    )
    bank: float = parameter(
        "rise of the road over the distance to the left", "m/m", -STEEPEST, STEEPEST, default=0.0
    )

    def __post_init__(self):
        keep_validated(self)

    def gravity(self, gravity: float) -> tuple[float, float, float]:
        """Acceleration of gravity into the road, along its x and along its y axis (m/s^2)."""
        down = gravity / math.sqrt(1.0 + self.grade**2 + self.bank**2)
        return down, -self.grade * down, -self.bank * down
