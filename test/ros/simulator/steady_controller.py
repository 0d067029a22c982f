"""A controller, as a program: gives the same steering and torque 50 times a second to its end."""

import rclpy
from peers import message_of
from rclpy.node import Node

from vehicle_roll_sim.messages.topics import COMMANDS
from vehicle_roll_sim.ros.topics import COMMANDING, message_class

VALUES = {"steering_cmd": 0.02, "wheel_torque_cmd": [5.0, 0.0, 0.0, 0.0]}


def main() -> None:
    rclpy.init()
    node = Node("controller")
    publishers = {
        topic.name: node.create_publisher(message_class(topic.type), topic.name, COMMANDING)
        for topic in COMMANDS
        if topic.name in VALUES
    }

    def command() -> None:
        for name, publisher in publishers.items():
            publisher.publish(message_of(name, VALUES[name]))

    node.create_timer(0.02, command)
    rclpy.spin(node)


if __name__ == "__main__":
    main()
