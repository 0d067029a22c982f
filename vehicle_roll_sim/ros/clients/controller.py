"""The base of controllers: nodes that answer every set of messages with one command each.

In lockstep a period is run once every command topic has brought a message, and it begins as soon as
every one has a publisher. So a controller makes its publishers when everything else is connected:
the topics that it hears have a publisher, whose node has found it, and its answers have a listener.
A chain of controllers is connected from the simulator on, and none misses the first set.
"""

import math
import sys
import time
from collections.abc import Mapping

import rclpy
from rcl_interfaces.msg import ParameterDescriptor
from rcl_interfaces.srv import GetParameters
from rclpy.node import Node
from rclpy.qos import QoSProfile

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.declaration import InputError, unknown_name
from vehicle_roll_sim.live.command_inbox import channels
from vehicle_roll_sim.messages.joined import KEPT, JoinedSets
from vehicle_roll_sim.messages.topics import COMMANDS, PUBLISHED, STATE_SET, Topic
from vehicle_roll_sim.ros.compatibility import UNNAMED
from vehicle_roll_sim.ros.process import LOOK, lifetime, node_main, refuse_unknown_parameters
from vehicle_roll_sim.ros.qos_overrides import (
    make_publisher,
    make_subscription,
    refuse_wrong_overrides,
)
from vehicle_roll_sim.ros.topics import message_class

ASK_AGAIN = 1.0
"""s after which a question is repeated: a node that has not found us yet drops its answer."""
QUEUED = QoSProfile(depth=KEPT)
HEARD = {topic.name: topic for topic in (*STATE_SET, *COMMANDS)}
"""What controllers can hear, beside what they say to each other."""
SIZES = {name: channel.size for name, channel in channels().items()}
"""Values that a command has."""


class Controller(Node):
    """A node that hears some topics, and answers every set of their messages.

    A subclass declares `node_name`, the topics that it has `heard`, and those that it has `said`:
    names of topics of the simulator, or, of those between controllers, `Topic(name, type)`.
    """

    node_name = ""
    heard: tuple[str | Topic, ...] = ()
    said: tuple[str | Topic, ...] = ()
    needs_listener = True
    """Whether it waits for somebody to listen to its answers."""

    def __init__(self):
        if not self.node_name:
            raise InputError("node_name", None, "the name of the controller's node")
        heard, self._said = heard_topics(self.heard), said_topics(self.said)
        super().__init__(self.node_name)
        refuse_wrong_overrides(self, publishers=self._said, subscriptions=heard)
        self._sets, self._publishers_of = JoinedSets(heard), {}
        self._subscriptions_of = [self._listen_to(topic) for topic in heard.values()]

    def answer(self, *messages):
        """The data of the answer to one set: a message of each topic in `heard`, in that order.

        A number or the values of an array; with several topics in `said` a dict with the data of
        each by its name. To be written by the controller.
        """
        raise NotImplementedError

    def parameter(self, name: str, default: float) -> float:
        """The value of a ROS parameter, for which an integer serves as well."""
        any_number = ParameterDescriptor(dynamic_typing=True)
        return float(self.declare_parameter(name, default, any_number).value)

    def prepare(self) -> None:
        """What else is to be done before the first message."""

    def run(self) -> None:
        """Connect, then answer until the end."""
        while not self._others_are_there():
            self.executor.spin_once(timeout_sec=LOOK)
        self._make_known()
        self.prepare()
        self._publishers_of = {
            name: make_publisher(self, message_class(topic.type), name, QUEUED)
            for name, topic in self._said.items()
        }
        while rclpy.ok():
            self.executor.spin_once(timeout_sec=LOOK)

    def _listen_to(self, topic: Topic):
        def listen(message, info: dict) -> None:
            complete = self._sets.add(topic.name, info["source_timestamp"], message)
            if complete and self._publishers_of:
                self._say(self.answer(*complete))

        return make_subscription(self, message_class(topic.type), topic.name, listen, QUEUED)

    def _say(self, answer) -> None:
        """Publish an answer, one message on each topic."""
        if len(self._said) == 1:
            answer = dict.fromkeys(self._said, answer)
        if not isinstance(answer, Mapping) or answer.keys() != self._said.keys():
            raise InputError("answer", answer, f"a dict with {' and '.join(self._said)}")
        messages = {name: message_of(topic, answer[name]) for name, topic in self._said.items()}
        for name, message in messages.items():
            self._publishers_of[name].publish(message)

    def _found(self) -> list:
        """The endpoint that publishes each topic that is heard, None where there is none yet."""
        return [
            next(iter(self.get_publishers_info_by_topic(each.topic_name)), None)
            for each in self._subscriptions_of
        ]

    def _others_are_there(self) -> bool:
        are_named = all(each and each.node_name != UNNAMED for each in self._found())
        return are_named and (
            not self.needs_listener or all(map(self.count_subscribers, self._said))
        )

    def _make_known(self) -> None:
        """Ask each node that is heard for a parameter until it answers.

        Endpoints are made known in order, so that it has then found our subscriptions, too.
        """
        found = filter(None, self._found())
        nodes = {f"{each.node_namespace.rstrip('/')}/{each.node_name}" for each in found}
        for node in sorted(nodes):
            client = self.create_client(GetParameters, f"{node}/get_parameters")
            asked, answer = -math.inf, None
            while not (answer and answer.done()):
                if client.service_is_ready() and time.monotonic() > asked + ASK_AGAIN:
                    asked = time.monotonic()
                    answer = client.call_async(GetParameters.Request(names=["use_sim_time"]))
                self.executor.spin_once(timeout_sec=LOOK)
            self.destroy_client(client)


def heard_topics(declared: tuple[str | Topic, ...] | str) -> dict[str, Topic]:
    """Topics by name of which every set has a message; raises InputError for others."""
    found = _topics("heard", declared, HEARD | {topic.name: topic for topic in PUBLISHED})
    for name in found:
        if any(name == topic.name for topic in PUBLISHED) and name not in HEARD:
            problem = f"{name} is not published with every set"
            raise InputError("heard", name, f"one of {', '.join(HEARD)}", problem)
    return found


def said_topics(declared: tuple[str | Topic, ...] | str) -> dict[str, Topic]:
    """Topics by name that a controller may answer with; raises InputError for others."""
    return _topics("said", declared, {topic.name: topic for topic in COMMANDS})


def _topics(field: str, declared, known: dict[str, Topic]) -> dict[str, Topic]:
    found = {}
    for each in (declared,) if isinstance(declared, str | Topic) else declared:
        if not isinstance(each, Topic) and each not in known:
            raise unknown_name(each, known, field)
        topic = each if isinstance(each, Topic) else known[each]
        found[topic.name] = topic
    if not found:
        raise InputError(field, declared, "one topic or more")
    return found


def message_of(topic: Topic, data):
    """A message with a number or an array as its data; raises InputError where it takes no such.

    Values are not judged here: the simulator drops or limits them, and says so.
    """
    kind, size = message_class(topic.type), SIZES.get(topic.name)
    field = kind.get_fields_and_field_types()["data"]
    is_array, number = field.startswith("sequence"), _number_type(field)
    wanted = (f"{size} numbers" if size else "numbers") if is_array else "a number"
    problem = InputError(f"answer on {topic.name}", data, wanted)
    try:
        message = kind(data=[number(each) for each in data] if is_array else number(data))
    except (AssertionError, TypeError, ValueError, OverflowError):
        raise problem from None
    if is_array and size and len(message.data) != size:
        raise problem
    return message


def _number_type(field: str) -> type:
    """What the elements of a field of that type are in Python."""
    if "boolean" in field:
        return bool
    return float if "float" in field or "double" in field else int


def run(kind: type[Controller]) -> None:
    """Run a controller until SIGINT or SIGTERM, which end it with status 0."""

    def body(_) -> int:
        controller = kind()
        refuse_unknown_parameters(controller)
        with lifetime(controller):
            controller.run()
        return 0

    sys.exit(node_main(OneLineParser(), body, sys.argv))
