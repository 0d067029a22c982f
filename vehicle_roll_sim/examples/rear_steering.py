#!/usr/bin/env python3
"""Example controller: rear steering in phase with the front reduces the lateral acceleration.

Answers `imu` with `rear_steering_cmd`. The law, and its parameters, are those of
vehicle_roll_sim.control_laws.rear_steering, which needs no ROS and can also be used in studies.
"""

from vehicle_roll_sim.controller import Controller, run  # isort: split

from vehicle_roll_sim.control_laws import rear_steering


class RearSteering(Controller):
    node_name = "rear_steering"
    heard = ("imu",)
    said = ("rear_steering_cmd",)

    def __init__(self):
        super().__init__()
        self.law = self.parameters_for(rear_steering.RearSteering)

    def answer(self, imu) -> float:
        return self.law.angle(imu.angular_velocity.z)


def main() -> None:
    run(RearSteering)


if __name__ == "__main__":
    main()
