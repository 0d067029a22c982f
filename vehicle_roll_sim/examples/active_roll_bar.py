#!/usr/bin/env python3
"""Example controller: active roll bars take up part of the roll moment and damp the roll.

Answers `imu` with `normal_force_cmd`. The roll moment of the body is m h ay, where ay is the
lateral specific force (it includes gravity as the body rolls), m the sprung mass and h the height
of its c.g. above the roll axis. With the roll rate p, the bars apply the moment

    M = share m h ay + damping p

as a pair of opposite forces M / track on each axle, distributed front to rear by `front_share`. If
that share exceeds the front share of the spring roll stiffness, the vehicle understeers more.
"""

from vehicle_roll_sim.controller import Controller, run


class ActiveRollBar(Controller):
    node_name = "active_roll_bar"
    heard = ("imu",)
    said = ("normal_force_cmd",)

    def __init__(self):
        super().__init__()
        self.share = self.parameter("share", 0.7)  # of the roll moment, below 1
        self.moment = self.parameter("moment", 900.0)  # m h, kg m
        self.damping = self.parameter("damping", 4000.0)  # N m s/rad
        self.front_share = self.parameter("front_share", 0.6)
        self.track = self.parameter("track", 1.5)  # m
        self.largest = self.parameter("largest_force", 3000.0)  # N, at a corner

    def answer(self, imu) -> list[float]:
        moment = self.share * self.moment * imu.linear_acceleration.y
        moment += self.damping * imu.angular_velocity.x
        front = self.limited(self.front_share * moment / self.track)
        rear = self.limited((1 - self.front_share) * moment / self.track)
        return [-front, front, -rear, rear]

    def limited(self, force: float) -> float:
        return max(-self.largest, min(self.largest, force))


def main() -> None:
    run(ActiveRollBar)


if __name__ == "__main__":
    main()
