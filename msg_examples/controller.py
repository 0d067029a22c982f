"""What the controllers here have in common: one answer for every message of one topic.

That is all that lockstep wants. It begins as soon as every command has a publisher, so a controller
makes its own when everything else is connected: the topic that it listens to has a publisher, whose
node has found it, and the answer has a listener. A chain of controllers thus connects from the
simulator on, and nobody misses the first set.
"""

import math
import sys
import time

from vehicle_roll_sim.ros import ending

ending.at_once()  # a signal that comes while rclpy is imported; later ones are seen to in `run`

import rclpy
from rcl_interfaces.msg import ParameterDescriptor
from rcl_interfaces.srv import GetParameters
from rclpy.node import Node
from rclpy.qos import QoSProfile

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.ros.process import (
    LOOK,
    lifetime,
    node_main,
    refuse_unknown_parameters,
)
from vehicle_roll_sim.ros.qos_overrides import (
    make_publisher,
    make_subscription,
    refuse_wrong_overrides,
)

ASK_AGAIN = 1.0
"""s after which a question is repeated: a node that has not found us yet drops its answer."""
UNNAMED = "_NODE_NAME_UNKNOWN_"
"""Node of an endpoint that was found before its node."""
QUEUED = QoSProfile(depth=10)
"""Messages that wait to be handled; in lockstep there is never more than one."""


class Controller(Node):
    """A node `name` that answers messages of a topic; both topics as (name, message type)."""

    needs_listener = True
    """Whether it waits for somebody to listen to its answers."""

    def __init__(self, name: str, heard: tuple[str, type], said: tuple[str, type]):
        super().__init__(name)
        self._said, self._publisher = said, None
        self._heard = make_subscription(self, heard[1], heard[0], self._listen, QUEUED)

    def answer(self, message):
        """The data of the answer to a message; to be written by the controller."""
        raise NotImplementedError

    def parameter(self, name: str, default: float) -> float:
        """The value of a ROS parameter, for which an integer serves as well."""
        any_number = ParameterDescriptor(dynamic_typing=True)
        return float(self.declare_parameter(name, default, any_number).value)

    def prepare(self) -> None:
        """What else is to be done before the first message."""

    def refuse_wrong_overrides(self) -> None:
        """Raise InputError for a quality of service of a topic that is not the controller's."""
        refuse_wrong_overrides(
            self,
            publishers=[self._said[0], *(each.topic_name for each in self.publishers)],
            subscriptions=[each.topic_name for each in self.subscriptions],
        )

    def run(self) -> None:
        """Connect, then answer until the end."""
        while not self._others_are_there():
            self.executor.spin_once(timeout_sec=LOOK)
        self._make_known()
        self.prepare()
        self._publisher = make_publisher(self, self._said[1], self._said[0], QUEUED)
        while rclpy.ok():
            self.executor.spin_once(timeout_sec=LOOK)

    def _others_are_there(self) -> bool:
        publishers = self.get_publishers_info_by_topic(self._heard.topic_name)
        is_named = bool(publishers) and publishers[0].node_name != UNNAMED
        return is_named and (self.count_subscribers(self._said[0]) > 0 or not self.needs_listener)

    def _make_known(self) -> None:
        """Ask the node that we listen to for a parameter until it answers.

        Endpoints are made known in order, so that it has then found our subscription, too.
        """
        other = self.get_publishers_info_by_topic(self._heard.topic_name)[0]
        name = f"{other.node_namespace.rstrip('/')}/{other.node_name}/get_parameters"
        client = self.create_client(GetParameters, name)
        asked, answer = -math.inf, None
        while not (answer and answer.done()):
            if client.service_is_ready() and time.monotonic() > asked + ASK_AGAIN:
                asked = time.monotonic()
                answer = client.call_async(GetParameters.Request(names=["use_sim_time"]))
            self.executor.spin_once(timeout_sec=LOOK)
        self.destroy_client(client)

    def _listen(self, message) -> None:
        if self._publisher:
            self._publisher.publish(self._said[1](data=self.answer(message)))


def run(kind: type[Controller]) -> None:
    """Run a controller until SIGINT or SIGTERM, which end it with status 0."""

    def body(_) -> int:
        controller = kind()
        refuse_unknown_parameters(controller)
        controller.refuse_wrong_overrides()
        with lifetime(controller):
            controller.run()
        return 0

    sys.exit(node_main(OneLineParser(), body, sys.argv))
