"""A controller program: publishes constant steering and torque 50 times per second."""

from array import array

import rclpy
from rclpy.node import Node

from vehicle_roll_sim.messages.command_topics import COMMANDS
from vehicle_roll_sim.ros.topics import COMMANDING, message_class

VALUES = {"steering_cmd": 0.02, "wheel_torque_cmd": array("d", [5.0, 0.0, 0.0, 0.0])}


def main() -> None:
    rclpy.init()
    node = Node("controller")
    commanded = [topic for topic in COMMANDS if topic.name in VALUES]
    messages = [message_class(topic.type)(data=VALUES[topic.name]) for topic in commanded]
    publishers = [
        node.create_publisher(type(message), topic.name, COMMANDING)
        for topic, message in zip(commanded, messages, strict=True)
    ]

    def command() -> None:
        for publisher, message in zip(publishers, messages, strict=True):
            publisher.publish(message)

    node.create_timer(0.02, command)
    rclpy.spin(node)


if __name__ == "__main__":
    main()
