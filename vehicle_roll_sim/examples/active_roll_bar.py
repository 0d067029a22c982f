#!/usr/bin/env python3
"""Example controller: active roll bars take up part of the roll moment and damp the roll.

Answers `imu` with `normal_force_cmd`. The law, and its parameters, are those of
vehicle_roll_sim.control_laws.active_roll_bar, which needs no ROS and can also be used in studies.
"""

from vehicle_roll_sim.controller import Controller, run  # isort: split

from vehicle_roll_sim.control_laws import active_roll_bar


class ActiveRollBar(Controller):
    node_name = "active_roll_bar"
    heard = ("imu",)
    said = ("normal_force_cmd",)

    def __init__(self):
        super().__init__()
        self.law = self.parameters_for(active_roll_bar.ActiveRollBar)

    def answer(self, imu) -> list[float]:
        return self.law.forces(imu.linear_acceleration.y, imu.angular_velocity.x)


def main() -> None:
    run(ActiveRollBar)


if __name__ == "__main__":
    main()
