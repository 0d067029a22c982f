#!/usr/bin/env python3
"""A controller to start from: active forces in the suspension carry part of the load transfer.

Reads `tire_normal_forces`, answers with `normal_force_cmd`. On each axle the outer corner is
pushed up and the inner one pulled down, so that the body rolls less.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float64MultiArray

AXLES = ((0, 1), (2, 3))
"""Left and right wheel of each axle in the order lf, rf, lr, rr."""


class ActiveRollBar(Node):
    def __init__(self):
        super().__init__("active_roll_bar")
        self.share = self.declare_parameter("share", 0.5).value  # of the load transfer, 0 to 0.8
        self.smoothing = self.declare_parameter("smoothing", 0.2).value  # weight of a new value
        self.largest = self.declare_parameter("largest_force", 4000.0).value  # N
        self.transfer = [0.0, 0.0]
        self.command = self.create_publisher(Float64MultiArray, "normal_force_cmd", 1)
        self.create_subscription(Float64MultiArray, "tire_normal_forces", self.answer, 1)

    def answer(self, loads: Float64MultiArray) -> None:
        forces = [0.0] * 4
        for axle, (left, right) in enumerate(AXLES):
            measured = (loads.data[right] - loads.data[left]) / 2
            self.transfer[axle] += self.smoothing * (measured - self.transfer[axle])
            force = max(-self.largest, min(self.largest, self.share * self.transfer[axle]))
            forces[left], forces[right] = -force, force
        self.command.publish(Float64MultiArray(data=forces))


def main() -> None:
    rclpy.init()
    try:
        rclpy.spin(ActiveRollBar())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
