"""Electronic stability control: braking of single wheels by yaw-rate and roll thresholds.

The reference is the yaw rate of the steady turn of a bicycle model, which tires and c.g. height
limit,

    r = u d / (wheelbase + understeer u^2), at most grip g / u,

delayed by a first-order lag, as the vehicle cannot follow the steering at once. Each intervention
has a threshold at which it begins and a lower one at which it ends (hysteresis):

- the yaw rate exceeds the reference: brake the outer front wheel, which turns the vehicle out;
- the yaw rate falls short of it: brake the inner rear wheel, which turns the vehicle in;
- the roll angle, extrapolated by `roll_lead` with the roll rate, is too large: brake the outer
  front wheel hard, which reduces the lateral force, and the other front wheel half as hard.
"""

import dataclasses
import math
from collections.abc import Mapping

from vehicle_roll_sim.analysis.handling import gradients_of
from vehicle_roll_sim.control_laws.motion_law import MotionLaw
from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.model.records import LF, LR, RF, RR, WHEEL_COUNT
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

GRAVITY = 9.81
"""m/s^2"""
GENTLE_SPEED = 20.0
"""m/s: speed at which the understeer gradient is determined."""
SLOWEST = 1.0
"""m/s: below, the control does nothing."""


class Hysteresis:
    """On from when a value reaches `on` until it has dropped to `off`."""

    def __init__(self, on: float, off: float):
        self.on, self.off, self.is_on = on, off, False

    def update(self, value: float) -> bool:
        self.is_on = value > self.off if self.is_on else value >= self.on
        return self.is_on


@dataclasses.dataclass(kw_only=True)
class StabilityControl(MotionLaw):
    """The stability control; its fields are thresholds and gains.

    `begin` determines `wheelbase` (m) and `understeer`, the gradient of the road-wheel angle over
    lateral acceleration (rad/(m/s^2)) in gentle steady turns of the vehicle.
    """

    commands = ("brake_torque",)

    grip: float = parameter(
        "largest lateral acceleration of the reference, over g", "", 0.0, 2.0, default=0.6
    )
    reference_lag: float = parameter(
        "time constant of the reference yaw rate", "s", 0.0, 10.0, default=0.1
    )
    yaw_on: float = parameter(
        "yaw-rate error at which braking begins", "rad/s", 0.0, 10.0, default=0.06
    )
    yaw_off: float = parameter(
        "yaw-rate error at which braking ends", "rad/s", 0.0, 10.0, default=0.02
    )
    yaw_gain: float = parameter(
        "brake torque per yaw-rate error", "N m s", 0.0, 1e6, default=6000.0
    )
    roll_on: float = parameter(
        "extrapolated roll angle at which braking begins", "rad", 0.0, 2.0, default=0.14
    )
    roll_off: float = parameter(
        "extrapolated roll angle at which braking ends", "rad", 0.0, 2.0, default=0.09
    )
    roll_lead: float = parameter(
        "time by which the roll angle is extrapolated", "s", 0.0, 10.0, default=0.15
    )
    roll_torque: float = parameter(
        "brake torque at the outer front wheel against roll", "N m", 0.0, 1e6, default=2000.0
    )
    largest_torque: float = parameter(
        "largest brake torque at a wheel", "N m", 0.0, 1e6, default=2000.0
    )

    def __post_init__(self):
        super().__post_init__()
        for on, off in (("yaw_on", "yaw_off"), ("roll_on", "roll_off")):
            if getattr(self, off) > getattr(self, on):
                raise InputError(off, getattr(self, off), f"at most {on}, {getattr(self, on):g}")

    def begin(self, vehicle: Vehicle, options: Options) -> None:
        self.wheelbase = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
        self.understeer = gradients_of(vehicle, options, speed=GENTLE_SPEED).understeer
        super().begin(vehicle, options)

    def restart(self) -> None:
        super().restart()
        self._reference, self._before = 0.0, math.nan
        self._yaw = Hysteresis(self.yaw_on, self.yaw_off)
        self._roll = {side: Hysteresis(self.roll_on, self.roll_off) for side in (1.0, -1.0)}

    def commanded(self, motion: Mapping[str, float]) -> dict:
        if motion["u"] < SLOWEST:
            return {"brake_torque": (0.0,) * WHEEL_COUNT}
        reference = self._delayed(motion)
        against_yaw = self._against_yaw(motion["yaw_rate"], reference)
        against_roll = self._against_roll(motion["roll"], motion["roll_rate"])
        largest = self.largest_torque
        pairs = zip(against_yaw, against_roll, strict=True)
        return {"brake_torque": tuple(min(largest, max(pair)) for pair in pairs)}

    def wanted(self, speed: float, steering: float) -> float:
        """The yaw rate (rad/s) of the steady turn at a speed (m/s) and road-wheel angle (rad)."""
        rate = speed * steering / (self.wheelbase + self.understeer * speed**2)
        most = self.grip * GRAVITY / speed
        return max(-most, min(most, rate))

    def _delayed(self, motion: Mapping[str, float]) -> float:
        """The reference at the present time, behind its lag."""
        wanted, passed = self.wanted(motion["u"], motion["steering"]), motion["time"] - self._before
        if math.isnan(passed):
            self._reference = wanted
        else:
            lag = self.reference_lag
            self._reference += passed / (lag + passed) * (wanted - self._reference)
        self._before = motion["time"]
        return self._reference

    def _against_yaw(self, yaw_rate: float, reference: float) -> list[float]:
        error, torques = yaw_rate - reference, [0.0] * WHEEL_COUNT
        if not self._yaw.update(abs(error)):
            return torques
        if error * yaw_rate > 0.0:  # yaws too much
            wheel = RF if yaw_rate > 0.0 else LF
        else:
            wheel = LR if reference > 0.0 else RR
        torques[wheel] = self.yaw_gain * abs(error)
        return torques

    def _against_roll(self, roll: float, roll_rate: float) -> list[float]:
        ahead, torques = roll + self.roll_lead * roll_rate, [0.0] * WHEEL_COUNT
        for (side, threshold), wheels in zip(self._roll.items(), ((RF, LF), (LF, RF)), strict=True):
            if threshold.update(side * ahead):
                outer, inner = wheels
                torques[outer] = self.roll_torque
                torques[inner] = 0.5 * self.roll_torque
        return torques
