"""The road: a plane with a grade and a bank."""

import dataclasses
import math

from vehicle_roll_sim.declaration import keep_validated, parameter

STEEPEST = 1.0
"""m/m: a slope of 45 degrees."""


@dataclasses.dataclass(frozen=True)
class Road:
    """An inclined plane that contains the x axis (initial heading) and y axis (left) of the ground.

    The slope is modelled by rotating gravity, so all positions, heights and attitudes are relative
    to the road. Raises InputError for a slope outside the allowed range.
    """

    grade: float = parameter(
        "slope of the road in the initial heading, positive uphill",
        "m/m",
        -STEEPEST,
        STEEPEST,
        default=0.0,
    )
    bank: float = parameter(
        "slope of the road across the initial heading, positive if it rises to the left",
        "m/m",
        -STEEPEST,
        STEEPEST,
        default=0.0,
    )

    def __post_init__(self):
        keep_validated(self)

    def gravity(self, gravity: float) -> tuple[float, float, float]:
        """Components of gravity into the road, along its x axis and along its y axis (m/s^2).

        gravity: magnitude of the acceleration of gravity (m/s^2).
        """
        down = gravity / math.sqrt(1.0 + self.grade**2 + self.bank**2)
        return down, -self.grade * down, -self.bank * down
