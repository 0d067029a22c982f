"""Single-wheel braking keeps the yaw rate near the one steered for.

The reference is the yaw rate of the steady turn at the steering angle d and the speed u,

    r = u d / (wheelbase + understeer u^2), at most grip g / u.

If the vehicle yaws faster, the outer front wheel is braked; if it yaws more slowly, the inner rear
one. The torque is `gain` per rad/s beyond a dead band, at most `braking` times the wheel's normal
load.
"""

import dataclasses
from collections.abc import Sequence

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.model.records import LF, LR, RF, RR, WHEEL_COUNT
from vehicle_roll_sim.runs.control_law import ControlLaw, Sensed

GRAVITY = 9.81  # m/s^2


@dataclasses.dataclass(kw_only=True)
class YawControl(ControlLaw):
    """The brake torques of a yaw rate that is not the reference."""

    commands = ("brake_torque",)

    wheelbase: float = parameter("wheelbase", "m", 0.1, 20.0, default=2.54)
    understeer: float = parameter(
        "understeer gradient of the reference", "rad s^2/m", -1.0, 1.0, default=0.0015
    )
    grip: float = parameter(
        "largest reference lateral acceleration, over g", "", 0.0, 10.0, default=0.6
    )
    gain: float = parameter("brake torque per yaw rate", "N m s/rad", 0.0, 1e6, default=6000.0)
    dead_band: float = parameter("dead band of the yaw rate", "rad/s", 0.0, 10.0, default=0.03)
    braking: float = parameter("largest torque over normal load", "m", 0.0, 10.0, default=0.25)

    def answer(self, sensed: Sensed) -> dict:
        speed, yaw_rate = float(sensed.state["u"]), float(sensed.state["yaw_rate"])
        loads = sensed.outputs["normal_force"].tolist()
        return {"brake_torque": self.torques(speed, sensed.applied.steering, yaw_rate, loads)}

    def torques(
        self, speed: float, steering: float, yaw_rate: float, loads: Sequence[float]
    ) -> list[float]:
        """Brake torque (N m) at lf, rf, lr, rr, from m/s, rad, rad/s and the normal loads (N)."""
        excess = yaw_rate - self.wanted(speed, steering)
        turns_left = yaw_rate > 0.0
        turns_too_much = excess * yaw_rate > 0.0
        outer_front, inner_rear = (RF, LR) if turns_left else (LF, RR)
        wheel = outer_front if turns_too_much else inner_rear
        torques = [0.0] * WHEEL_COUNT
        asked = self.gain * max(0.0, abs(excess) - self.dead_band)
        torques[wheel] = min(asked, self.braking * loads[wheel])
        return torques

    def wanted(self, speed: float, steering: float) -> float:
        """The reference yaw rate (rad/s) for a steering angle (rad) at a speed (m/s)."""
        rate = speed * steering / (self.wheelbase + self.understeer * speed**2)
        most = self.grip * GRAVITY / max(speed, 1.0)
        return max(-most, min(most, rate))
