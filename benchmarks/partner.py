"""A node that replaces the simulator but has no model: it answers each command with fixed messages.

usage: python -m benchmarks.partner bare|plain TOPIC ...
"""

import sys

from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.serialization import deserialize_message

from benchmarks.peer import TOPICS
from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.messages.sets import Messages
from vehicle_roll_sim.ros.encoding import encode
from vehicle_roll_sim.ros.node_main import node_main
from vehicle_roll_sim.ros.simulator.lockstep import SETTLING
from vehicle_roll_sim.ros.topics import EVERY_ANSWER, message_class, offered_qos

LOOK = 0.02
"""Poll interval (s) while waiting for the controller."""


class Partner(Node):
    """plain: a node with rclpy's defaults and message objects; else one stripped to the minimum."""

    def __init__(self, plain: bool, names: list[str]):
        usual = {"start_parameter_services": plain, "enable_rosout": plain}
        super().__init__("partner", **usual)
        events = {
            kind: None if plain else kind(use_default_callbacks=False)
            for kind in (PublisherEventCallbacks, SubscriptionEventCallbacks)
        }
        messages = Messages(Simulation(preset()), "", encode)
        self.outgoing = []
        for name in names:
            topic, data = TOPICS[name], messages.builder(name)()
            kind = message_class(topic.type)
            publisher = self.create_publisher(
                kind, name, offered_qos(topic), event_callbacks=events[PublisherEventCallbacks]
            )
            self.outgoing.append((publisher, deserialize_message(data, kind) if plain else data))
        command = TOPICS["steering_cmd"]
        self.commands = self.create_subscription(
            message_class(command.type),
            command.name,
            self.answer,
            EVERY_ANSWER,
            event_callbacks=events[SubscriptionEventCallbacks],
        )

    def answer(self, _=None) -> None:
        """Publish all messages."""
        for publisher, message in self.outgoing:
            publisher.publish(message)

    def is_complete(self) -> bool:
        """Whether the controller is connected."""
        listened = all(publisher.get_subscription_count() for publisher, _ in self.outgoing)
        return listened and self.commands.get_publisher_count() > 0


def main() -> int:
    parser = OneLineParser(prog="partner", description=__doc__.partition("\n")[0])
    parser.add_argument("kind", choices=("bare", "plain"))
    parser.add_argument("topics", nargs="+", choices=tuple(TOPICS))

    def body(arguments) -> int:
        partner = Partner(arguments.kind == "plain", arguments.topics)
        executor = SingleThreadedExecutor()
        executor.add_node(partner)
        while not partner.is_complete():
            executor.spin_once(timeout_sec=LOOK)
        executor.spin_once(timeout_sec=SETTLING)
        partner.answer()
        executor.spin()
        return 0

    return node_main(parser, body, sys.argv)


if __name__ == "__main__":
    sys.exit(main())
