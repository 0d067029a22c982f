"""Soil trip: a vehicle slides sideways on ice into soft soil, whose furrows slow its wheels."""

import dataclasses

from vehicle_roll_sim.manoeuvres.on_roads.rigid_block import critical_speed_in_furrow
from vehicle_roll_sim.manoeuvres.on_roads.sliding import BEHIND, LONG, SlidingTrip
from vehicle_roll_sim.roads.surfaces import SoftSoil, Soil
from vehicle_roll_sim.runs.metrics import LEFT, RIGHT
from vehicle_roll_sim.vehicle.parameters import Vehicle

WIDE = 1000.0
"""m: the soil does not end where the vehicle comes to rest."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class SoilTrip(Soil, SlidingTrip):
    """A vehicle that stands on ice slides sideways into soft soil.

    The tires have no friction on the soil either: only its furrows resist them. `critical` is the
    speed of a block that is slowed by the furrows of the leading wheels with its whole weight.
    """

    def critical_speed(
        self, vehicle: Vehicle, half_track: float, height: float, gyration: float
    ) -> float:
        resistance = self.resistance(vehicle) / vehicle.mass
        return critical_speed_in_furrow(half_track, height, gyration, resistance)

    def resistance(self, vehicle: Vehicle) -> float:
        """Forces of the furrows (N) of the wheels of one side, when they carry the whole weight."""
        loads = vehicle.static_tire_load
        sinkage = (loads[LEFT] + loads[RIGHT]) / self.stiffness
        linear, quadratic = self.resistances
        return float((linear * sinkage + quadratic * sinkage**2).sum())

    def trips(self, offset: float) -> tuple:
        edge = {"right": 0.0, "left": WIDE} if offset > 0 else {"left": 0.0, "right": -WIDE}
        place = {"start": BEHIND, "length": LONG, "offset": offset}
        return (SoftSoil(**place, **edge, **self.soil_values()),)


SOIL_TRIP = SoilTrip(
    speed=0.0,
    sliding_speed=8.0,
    duration=12.0,
    stiffness=2.5e4,
    cohesion=2e4,
    contact_length=0.5,
)
"""Stiff clay, into which the reference vehicle sinks by 0.17 m on average."""
