#!/usr/bin/env python3
"""Example controller: single-wheel braking keeps the yaw rate near the one steered for.

Answers two topics of a set, `motion` (steering, speed, yaw rate) and `tire_normal_forces`, with
`brake_torque_cmd`. The reference is the yaw rate of the steady turn at the steering angle d and the
speed u,

    r = u d / (wheelbase + understeer u^2), at most grip g / u.

If the vehicle yaws faster, the outer front wheel is braked; if it yaws more slowly, the inner rear
one. The torque is `gain` per rad/s beyond a dead band, at most `braking` times the wheel's normal
load.
"""

from vehicle_roll_sim.controller import Controller, by_name, run

LF, RF, LR, RR = range(4)
GRAVITY = 9.81  # m/s^2


class YawControl(Controller):
    node_name = "yaw_control"
    heard = ("motion", "tire_normal_forces")
    said = ("brake_torque_cmd",)

    def __init__(self):
        super().__init__()
        self.wheelbase = self.parameter("wheelbase", 2.54)  # m
        self.understeer = self.parameter("understeer", 0.0015)  # rad per m/s^2
        self.grip = self.parameter("grip", 0.6)  # largest reference lateral acceleration, over g
        self.gain = self.parameter("gain", 6000.0)  # N m per rad/s
        self.dead_band = self.parameter("dead_band", 0.03)  # rad/s
        self.braking = self.parameter("braking", 0.25)  # m, largest torque over normal load

    def answer(self, motion, loads) -> list[float]:
        now = by_name(motion)
        excess = now["yaw_rate"] - self.wanted(now["u"], now["steering"])
        turns_left = now["yaw_rate"] > 0.0
        turns_too_much = excess * now["yaw_rate"] > 0.0
        outer_front, inner_rear = (RF, LR) if turns_left else (LF, RR)
        wheel = outer_front if turns_too_much else inner_rear
        torques = [0.0] * 4
        asked = self.gain * max(0.0, abs(excess) - self.dead_band)
        torques[wheel] = min(asked, self.braking * loads.data[wheel])
        return torques

    def wanted(self, speed: float, steering: float) -> float:
        """The reference yaw rate (rad/s) for a steering angle (rad) at a speed (m/s)."""
        rate = speed * steering / (self.wheelbase + self.understeer * speed**2)
        most = self.grip * GRAVITY / max(speed, 1.0)
        return max(-most, min(most, rate))


def main() -> None:
    run(YawControl)


if __name__ == "__main__":
    main()
