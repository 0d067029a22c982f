#!/usr/bin/env python3
"""A controller to start from: the rear wheels steer with the turn and take acceleration out of it.

Answers `imu` with `rear_steering_cmd`: gain times the yaw rate, to the same side as the front
wheels, at most `largest_angle`. The rear tires then carry their share with less sideslip of the
body, and the yaw rate, and with it the lateral acceleration, stays smaller.
"""

from vehicle_roll_sim.controller import Controller, run


class RearSteering(Controller):
    node_name = "rear_steering"
    heard = ("imu",)
    said = ("rear_steering_cmd",)

    def __init__(self):
        super().__init__()
        self.gain = self.parameter("gain", 0.12)  # rad per rad/s, s
        self.largest = self.parameter("largest_angle", 0.1)  # rad

    def answer(self, imu) -> float:
        angle = self.gain * imu.angular_velocity.z
        return max(-self.largest, min(self.largest, angle))


def main() -> None:
    run(RearSteering)


if __name__ == "__main__":
    main()
