"""A table that tilts the whole road about its x axis."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import Table, keep_validated, parameter

STEEPEST = 89.0
"""deg"""


@dataclasses.dataclass(frozen=True, kw_only=True)
class TiltTable:
    """A road that tilts sideways with time, such as the table of SAE J2180.

    The table and everything on it are described in its own frame, in which gravity turns. Its own
    acceleration is neglected: at the rates of a test, below 1 deg/s, it is far below 0.001 g.
    """

    angles: Table = parameter(
        "angle of the table over time, positive with the left side raised; linear between the "
        "points, constant before and after them",
        "deg",
        -STEEPEST,
        STEEPEST,
        over=("time (s)", 1e6),
    )

    def __post_init__(self):
        keep_validated(self)

    def table(self) -> np.ndarray:
        """Times (s) and angles (rad), shape (n, 2)."""
        return np.array([(time, math.radians(angle)) for time, angle in self.angles])

    def angle(self, time: float) -> float:
        """The angle at a time (rad)."""
        times, angles = self.table().T
        return float(np.interp(time, times, angles))
