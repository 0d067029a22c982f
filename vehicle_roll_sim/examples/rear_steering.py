#!/usr/bin/env python3
"""Example controller: rear steering in phase with the front reduces the lateral acceleration.

Answers `imu` with `rear_steering_cmd`: `gain` times the yaw rate, in the same direction as the
front wheels, limited to `largest_angle`. The rear tires then build up their lateral force with less
body sideslip, and the yaw rate and the lateral acceleration stay smaller.
"""

from vehicle_roll_sim.controller import Controller, run


class RearSteering(Controller):
    node_name = "rear_steering"
    heard = ("imu",)
    said = ("rear_steering_cmd",)

    def __init__(self):
        super().__init__()
        self.gain = self.parameter("gain", 0.12)  # rad per rad/s, that is, s
        self.largest = self.parameter("largest_angle", 0.1)  # rad

    def answer(self, imu) -> float:
        angle = self.gain * imu.angular_velocity.z
        return max(-self.largest, min(self.largest, angle))


def main() -> None:
    run(RearSteering)


if __name__ == "__main__":
    main()
