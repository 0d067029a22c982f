"""Braking in a turn, after ISO 7975: how braking alone disturbs a steady turn.

The text of the standard was not at hand. From public descriptions: an open-loop test, in which the
handwheel is held while the throttle is released and the brakes are applied. The lateral
acceleration, the radius, the rise of the brakes and the figures are choices made here.
"""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import ADAPTED, LONGEST
from vehicle_roll_sim.manoeuvres.turn_in import TurnIn
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import NO_FORCE, Feedback, Programme
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

LOOKED_AT = 1.0
"""s: yaw rate and path are compared with those of the turn this long after braking begins."""
STOPPED = 1.0
"""m/s: the mean deceleration is that down to this speed."""
UNKNOWN = "unknown: the run is too short"


@dataclasses.dataclass(frozen=True, kw_only=True)
class BrakingInATurn(TurnIn):
    """A steady turn at constant speed; then constant brake torques, with the handwheel held.

    `for_vehicle` sets the torques that slow the mass of the vehicle as required (N m).
    """

    deceleration: float = parameter(
        "deceleration that the brake torques would give without slip", "m/s^2", 0.0, 20.0
    )
    brakes_from: float = parameter("time at which braking begins", "s", 0.0, LONGEST)
    brake_rise: float = parameter("rise time of the brake torques", "s", 1e-3, LONGEST, default=0.2)
    brake_torques: tuple[float, ...] = NO_FORCE

    def __post_init__(self):
        super().__post_init__()
        if not self.brakes_from > self.start + self.rise:
            allowed = f"after the handwheel has been turned, at {self.start + self.rise:g} s"
            raise InputError("brakes_from", self.brakes_from, allowed)

    @property
    def throttle_dropped(self) -> float:
        return self.brakes_from

    @property
    def commanded(self) -> tuple[str, ...]:
        return (*super().commanded, "brake_torque")

    def turning_only(self) -> "BrakingInATurn":
        return dataclasses.replace(self, deceleration=0.0, duration=self.brakes_from)

    def filled_in(self, vehicle: Vehicle, options: Options) -> "BrakingInATurn":
        ready = super().filled_in(vehicle, options)
        force = vehicle.mass * self.deceleration * vehicle.brake_shares
        torques = tuple((force * vehicle.static_loaded_radius).tolist())
        return dataclasses.replace(ready, brake_torques=torques)

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        super().drive(times, commands)
        share = np.clip((times - self.brakes_from) / self.brake_rise, 0.0, 1.0)
        commands["brake_torque"] = np.outer(share, self.brake_torques).reshape(-1, len(WHEELS))

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        lines = {"handwheel angle": f"{self.handwheel_angle:.3f} deg", **self.limit_line()}
        if not history["time"][-1] >= self.brakes_from + LOOKED_AT:
            return lines | {"braking": UNKNOWN}
        radius, ratio, inwards = self.after_a_second(history)
        return lines | {
            "radius of the turn": f"{radius:.3f} m",
            "mean deceleration": f"{self.mean_deceleration(history):.3f} m/s^2",
            f"yaw rate after {LOOKED_AT:g} s": f"{ratio:.4f} of that on the circle at this speed",
            f"off the circle after {LOOKED_AT:g} s": f"{inwards:.3f} m inwards",
        }

    def mean_deceleration(self, history: History) -> float:
        """Mean deceleration (m/s^2) from full brake torques to 1 m/s, or to the end of the run."""
        time, speed = history["time"], np.hypot(history["u"], history["v"])
        braking = time >= self.brakes_from + self.brake_rise
        time, speed = time[braking], speed[braking]
        slow = speed < STOPPED
        end = int(np.argmax(slow)) if slow.any() else len(time) - 1
        return float((speed[0] - speed[end]) / (time[end] - time[0])) if end else math.nan

    def after_a_second(self, history: History) -> tuple[float, float, float]:
        """Radius of the turn (m), and the state of the turn after LOOKED_AT seconds of braking.

        The yaw rate over that on the circle at the present speed, and how far the vehicle is inside
        the circle (m). The circle is that of the velocity and the yaw rate when braking begins.
        """

        def at(when: float):
            names = ("x", "y", "yaw", "u", "v", "yaw_rate")
            return [float(np.interp(when, history["time"], history[name])) for name in names]

        x, y, yaw, u, v, rate = at(self.brakes_from)
        if rate == 0.0:
            return math.inf, math.nan, math.nan
        radius, course = math.hypot(u, v) / rate, yaw + math.atan2(v, u)
        centre = x - radius * math.sin(course), y + radius * math.cos(course)
        x, y, _, u, v, later = at(self.brakes_from + LOOKED_AT)
        ratio = later * radius / math.hypot(u, v)
        return abs(radius), ratio, abs(radius) - math.dist((x, y), centre)


BRAKING_IN_A_TURN = BrakingInATurn(
    speed=80 / 3.6,
    lateral_acceleration=5.0,
    rise=0.5,
    brakes_from=6.0,
    deceleration=4.0,
    duration=13.0,
    speed_hold=ADAPTED,
)
"""80 km/h and 5 m/s^2, a circle of 99 m; braking at 4 m/s^2."""
