"""Curb trip: a vehicle slides sideways on ice against a curb."""

import dataclasses

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.on_roads.rigid_block import critical_speed_at_curb
from vehicle_roll_sim.manoeuvres.on_roads.sliding import BEHIND, LONG, SlidingTrip
from vehicle_roll_sim.roads.heights import Curb
from vehicle_roll_sim.vehicle.parameters import Vehicle


@dataclasses.dataclass(frozen=True, kw_only=True)
class CurbTrip(SlidingTrip):
    """A vehicle that stands on ice slides sideways against a curb."""

    curb_height: float = parameter("height of the curb", "m", 0.01, 1.0, default=0.15)

    def critical_speed(
        self, vehicle: Vehicle, half_track: float, height: float, gyration: float
    ) -> float:
        return critical_speed_at_curb(half_track, height, gyration)

    def trips(self, offset: float) -> tuple:
        place = {"start": BEHIND, "offset": offset, "length": LONG}
        return (Curb(**place, height=self.curb_height, raised=self.side),)


CURB_TRIP = CurbTrip(speed=0.0, sliding_speed=6.0, duration=12.0)
"""Long enough for the slowest one to reach the curb."""
