#!/usr/bin/env python3
"""A controller to start from: brake the outer front wheel before the inner wheels lift.

Reads `tire_normal_forces`, answers with `wheel_torque_cmd`. Beyond a threshold of the load
transfer ratio the outer front wheel is slowed down: the vehicle turns out of the bend.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float64MultiArray

LF, RF, LR, RR = range(4)


class RollBraking(Node):
    def __init__(self):
        super().__init__("roll_braking")
        self.threshold = self.declare_parameter("threshold", 0.6).value  # load transfer ratio
        self.gain = self.declare_parameter("gain", 8000.0).value  # N m per unit beyond it
        self.largest = self.declare_parameter("largest_torque", 2500.0).value  # N m
        self.command = self.create_publisher(Float64MultiArray, "wheel_torque_cmd", 1)
        self.create_subscription(Float64MultiArray, "tire_normal_forces", self.answer, 1)

    def answer(self, loads: Float64MultiArray) -> None:
        left, right = loads.data[LF] + loads.data[LR], loads.data[RF] + loads.data[RR]
        if left + right <= 0.0:
            return
        ratio = (right - left) / (left + right)
        torque = min(self.largest, max(0.0, self.gain * (abs(ratio) - self.threshold)))
        torques = [0.0] * 4
        torques[RF if ratio > 0.0 else LF] = -torque
        self.command.publish(Float64MultiArray(data=torques))


def main() -> None:
    rclpy.init()
    try:
        rclpy.spin(RollBraking())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
