"""Curb trip: a vehicle slides sideways on ice against a curb."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import SIDES, OpenLoop
from vehicle_roll_sim.manoeuvres.on_roads.own_road import OnOwnRoad
from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.roads.heights import Curb
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
"""m: from the c.g. at which the ice is level again to the curb; no vehicle is wider than twice."""
BEHIND, LONG = -1000.0, 2000.0
"""m: where the curb begins, and its length."""


def critical_sliding_speed(half_track: float, cg_height: float, gyration: float) -> float:
    """The speed (m/s) from which a rigid block rolls over when its lower edge is stopped.

    m v h = J w, a plastic impact, and J w^2 / 2 = m g (r - h), with the distance r of the c.g. from
    the edge and J = m (k^2 + r^2). half_track, cg_height h and radius of gyration k in roll: m.
    """
    reach = math.hypot(half_track, cg_height)
    about_edge = gyration**2 + reach**2
    return math.sqrt(2 * GRAVITY * (reach - cg_height) * about_edge) / cg_height


def block_like(vehicle: Vehicle) -> tuple[float, float, float]:
    """Half track, height of the c.g. and radius of gyration in roll (m) of a whole vehicle."""
    record = vehicle.record()
    car, plane = record[0], RollPlane(record, suspended=False)
    unsprung, below = car["unsprung_mass"], plane.cg_height - car["static_wheel_height"]
    inertia = car["roll_inertia"] + car["sprung_mass"] * (car["cg_height"] - plane.cg_height) ** 2
    inertia += (unsprung * (car["y"] ** 2 + below**2)).sum()
    mass = car["sprung_mass"] + unsprung.sum()
    return plane.track / 2, plane.cg_height, math.sqrt(inertia / mass)


def least_tripping_speed(half_track: float, cg_height: float) -> float:
    """The speed (m/s) whose energy just lifts the c.g. above the edge: v^2 / 2 = g (r - h).

    half_track, cg_height: m. No rigid block rolls over at a lower speed, however elastic the curb.
    """
    return math.sqrt(2 * GRAVITY * (math.hypot(half_track, cg_height) - cg_height))


@dataclasses.dataclass(frozen=True, kw_only=True)
class CurbTrip(OnOwnRoad, OpenLoop):
    """A vehicle that stands on ice slides sideways against a curb.

    The ice tilts for 3 s, by the angle at which gravity gives the sliding speed, and is level again
    before the vehicle reaches the curb. `for_vehicle` sets the critical speed of a rigid block with
    the mass and the dimensions of the vehicle, and the least one by its energy (m/s; nan before).
    """

    sliding_speed: float = parameter("speed sideways at the curb", "m/s", 0.5, 15.0)
    curb_height: float = parameter("height of the curb", "m", 0.01, 1.0, default=0.15)
    side: str = parameter("side to which the vehicle slides", choices=tuple(SIDES), default="left")
    critical: float = math.nan
    least: float = math.nan

    needs_vehicle = True

    def __post_init__(self):
        super().__post_init__()
        if self.speed:
            raise InputError("speed", self.speed, "0: the vehicle slides; give sliding_speed")

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "CurbTrip":
        """A copy with the critical speed of a rigid block like the vehicle."""
        ready = super().for_vehicle(vehicle, options)
        half_track, height, gyration = block_like(vehicle)
        critical = critical_sliding_speed(half_track, height, gyration)
        least = least_tripping_speed(half_track, height)
        return dataclasses.replace(ready, critical=critical, least=least)

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
        curb = Curb(
            start=BEHIND,
            offset=side * (slid + AHEAD),
            length=LONG,
            height=self.curb_height,
            raised=self.side,
        )
        return Road(features=(table, Patch(start=BEHIND, friction=0.0), curb))

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        return {
            "sliding speed": f"{np.abs(history['v']).max():.3f} m/s",
            "critical speed of a block": f"{self.critical:.3f} m/s",
            "least speed by its energy": f"{self.least:.3f} m/s",
        }


CURB_TRIP = CurbTrip(speed=0.0, sliding_speed=6.0, duration=12.0)
"""Long enough for the slowest one to reach the curb."""
