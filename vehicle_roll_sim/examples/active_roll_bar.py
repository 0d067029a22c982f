#!/usr/bin/env python3
"""A controller to start from: active roll bars carry part of what rolls the body, and damp it.

Answers `imu` with `normal_force_cmd`. The body's roll moment is m h ay, with the lateral specific
force ay, gravity's share in a rolled body included, and m h the sprung mass times the height of its
c.g. above the roll axis. Of it, and against the roll rate p, the bars carry

    M = share m h ay + damping p,

as a pair of opposite forces on each axle: M / track, `front_share` of it in front. That more of it
is in front than the springs have there makes the vehicle understeer.
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
