"""Vehicles that stand on ice, and slide sideways against something that trips them."""

import abc
import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import SIDES, OpenLoop
from vehicle_roll_sim.manoeuvres.on_roads.own_road import OnOwnRoad
from vehicle_roll_sim.manoeuvres.on_roads.rigid_block import block_like, least_tripping_speed
from vehicle_roll_sim.roads.surfaces import Patch
from vehicle_roll_sim.roads.tilt import TiltTable
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.parameters import Vehicle

PHASE = 1.0
"""s: the ice tilts for this time, stays tilted for as long, and tilts back in the same time."""
AHEAD = 4.0
"""m: from the c.g. to what trips it when the ice is level again; above half of any width."""
BEHIND, LONG = -1000.0, 2000.0
"""m: where the ice and the curb or soil begin, and their length."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class SlidingTrip(OnOwnRoad, OpenLoop):
    """A vehicle that stands on ice slides sideways until something trips it.

    The ice tilts for 3 s, by the angle at which gravity gives the sliding speed, and is level again
    before the vehicle reaches what trips it. `for_vehicle` sets the critical speed of a rigid block
    with the mass and the dimensions of the vehicle, and the least speed from its energy (m/s; nan
    before).
    """

    sliding_speed: float = parameter("lateral speed when it is tripped", "m/s", 0.5, 15.0)
    side: str = parameter("side to which the vehicle slides", choices=tuple(SIDES), default="left")
    critical: float = math.nan
    least: float = math.nan

    needs_vehicle = True

    def __post_init__(self):
        super().__post_init__()
        if self.speed:
            raise InputError("speed", self.speed, "0: the vehicle slides; give sliding_speed")

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "SlidingTrip":
        """A copy with the critical speeds of a rigid block like the vehicle."""
        ready = super().for_vehicle(vehicle, options)
        half_track, height, gyration = block_like(vehicle)
        critical = self.critical_speed(vehicle, half_track, height, gyration)
        least = least_tripping_speed(half_track, height)
        return dataclasses.replace(ready, critical=critical, least=least)

    @abc.abstractmethod
    def critical_speed(
        self, vehicle: Vehicle, half_track: float, height: float, gyration: float
    ) -> float:
        """Critical speed (m/s) of a rigid block like the vehicle; its lengths in m."""

    @abc.abstractmethod
    def trips(self, offset: float) -> tuple:
        """The features of the road that trip it, from an offset to the left (m) on."""

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        """Nothing is commanded."""

    @property
    def tilt(self) -> float:
        """Angle of the ice (rad): gravity along it adds up to the sliding speed.

        v = g (2 (1 - cos a) / a + sin a) PHASE, the integral of g sin a(t).
        """
        wanted = self.sliding_speed / (GRAVITY * PHASE)
        low, high = 0.0, math.pi / 3
        while (middle := (low + high) / 2) not in (low, high):
            gained = 2 * (1 - math.cos(middle)) / middle + math.sin(middle)
            low, high = (middle, high) if gained < wanted else (low, middle)
        return high

    def own_road(self) -> Road:
        side = SIDES[self.side]
        angle = -side * math.degrees(self.tilt)
        times = (0.0, PHASE, 2 * PHASE, 3 * PHASE)
        table = TiltTable(angles=tuple(zip(times, (0.0, angle, angle, 0.0), strict=True)))
        slid = 1.5 * PHASE * self.sliding_speed  # the speed rises symmetrically about its half
        ice = Patch(start=BEHIND, friction=0.0)
        return Road(features=(table, ice, *self.trips(side * (slid + AHEAD))))

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        critical = "none: it stays upright" if math.isinf(self.critical) else _speed(self.critical)
        return {
            "sliding speed": self.sliding(history),
            "critical speed of a block": critical,
            "least speed by its energy": _speed(self.least),
        }

    def sliding(self, history: History) -> str:
        """The speed sideways when the ice is level again, before anything trips the vehicle."""
        time, level = history["time"], 3 * PHASE
        if time[-1] < level:
            return "unknown: the run is too short"
        return _speed(abs(float(np.interp(level, time, history["v"]))))


def _speed(value: float) -> str:
    return f"{value:.3f} m/s"
