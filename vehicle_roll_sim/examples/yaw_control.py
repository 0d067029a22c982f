#!/usr/bin/env python3
"""Example controller: single-wheel braking keeps the yaw rate near the one steered for.

Answers two topics of a set, `motion` (steering, speed, yaw rate) and `tire_normal_forces`, with
`brake_torque_cmd`. The law, and its parameters, are those of
vehicle_roll_sim.control_laws.yaw_control, which needs no ROS and can also be used in studies.
"""

from vehicle_roll_sim.controller import Controller, by_name, run  # isort: split

from vehicle_roll_sim.control_laws import yaw_control


class YawControl(Controller):
    node_name = "yaw_control"
    heard = ("motion", "tire_normal_forces")
    said = ("brake_torque_cmd",)

    def __init__(self):
        super().__init__()
        self.law = self.parameters_for(yaw_control.YawControl)

    def answer(self, motion, loads) -> list[float]:
        now = by_name(motion)
        return self.law.torques(now["u"], now["steering"], now["yaw_rate"], loads.data)


def main() -> None:
    run(YawControl)


if __name__ == "__main__":
    main()
