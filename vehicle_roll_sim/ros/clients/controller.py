"""The base class of controllers: nodes that answer every set of messages with commands.

Lockstep begins once every command topic has a publisher, and runs a period once each of them has
received a message. A controller therefore creates its publishers last, when everything else is
connected: the topics it hears have publishers, whose nodes have discovered it, and its answers have
a subscriber. So a chain of controllers connects from the simulator outwards, and none of them
misses the first set.
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
from vehicle_roll_sim.declaration import (
    InputError,
    number_of,
    parameters_of,
    unknown_name,
    validated,
)
from vehicle_roll_sim.live.channels import channels
from vehicle_roll_sim.messages.command_topics import COMMANDS
from vehicle_roll_sim.messages.set_synchronizer import KEPT, SetSynchronizer
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.messages.topics import OF_SOME_SETS, PUBLISHED, STATE_SET
from vehicle_roll_sim.ros.compatibility import UNNAMED
from vehicle_roll_sim.ros.node_main import LOOK, lifetime, node_main, refuse_unknown_parameters
from vehicle_roll_sim.ros.qos_overrides import (
    make_publisher,
    make_subscription,
    refuse_wrong_overrides,
)
from vehicle_roll_sim.ros.topics import message_class

ASK_AGAIN = 1.0
"""Time (s) after which a request is repeated: a node that has not found us yet drops its answer."""
QUEUED = QoSProfile(depth=KEPT)
HEARD = {topic.name: topic for topic in (*STATE_SET, *OF_SOME_SETS, *COMMANDS)}
"""What controllers can hear, besides topics among themselves."""
SIZES = {name: channel.size for name, channel in channels().items()}
"""The number of values of each command."""


class Controller(Node):
    """A node that subscribes to some topics and answers every set of their messages.

    A subclass declares its `node_name`, the topics `heard` (subscribed) and the topics `said`
    (published): the names of the simulator's topics, or `Topic(name, type)` for topics between
    controllers. Raises InputError if a declaration or parameter is wrong.
    """

    node_name = ""
    heard: tuple[str | Topic, ...] = ()
    said: tuple[str | Topic, ...] = ()
    needs_listener = True
    """Whether it waits for a subscriber to its answers before it starts."""

    def __init__(self):
        if not self.node_name:
            raise InputError("node_name", None, "the name of the controller's node")
        heard, self._said = heard_topics(self.heard), said_topics(self.said)
        super().__init__(self.node_name)
        refuse_wrong_overrides(self, publishers=self._said, subscriptions=heard)
        self._sets, self._publishers_of = SetSynchronizer(heard), {}
        self._subscriptions_of = [self._listen_to(topic) for topic in heard.values()]

    def answer(self, *messages):
        """Compute the answer to one set. Each controller implements this method.

        messages: one message of each topic in `heard`, in that order. Returns the data to publish:
        a number or a sequence of numbers; with several topics in `said`, a dict of them by topic.
        """
        raise NotImplementedError

    def parameter(self, name: str, default: float) -> float:
        """Declare a ROS parameter and return its value; integers are accepted as numbers.

        Raises InputError for anything else.
        """
        any_number = ParameterDescriptor(dynamic_typing=True)
        return number_of(self.declare_parameter(name, default, any_number).value, name, "a number")

    def parameters_for(self, kind: type):
        """An instance of a declaring class, whose parameters, numbers, become ROS parameters.

        Raises InputError for one that is not allowed.
        """
        known = parameters_of(kind)
        given = {name: self.parameter(name, each.default) for name, each in known.items()}
        return kind(**validated(kind, given))

    def prepare(self) -> None:
        """Called once, connected but before the first answer; does nothing by default."""

    def run(self) -> None:
        """Connect, then answer until shutdown."""
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
        """Publish an answer: one message on each topic; raises InputError if its data are wrong."""
        if len(self._said) == 1:
            answer = dict.fromkeys(self._said, answer)
        if not isinstance(answer, Mapping) or answer.keys() != self._said.keys():
            raise InputError("answer", answer, f"a dict with {' and '.join(self._said)}")
        messages = {name: message_of(topic, answer[name]) for name, topic in self._said.items()}
        for name, message in messages.items():
            self._publishers_of[name].publish(message)

    def _found(self) -> list:
        """The publishing endpoint of each topic heard, None where there is none yet."""
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
        """Request a parameter from each node that is heard until it answers.

        Endpoints are announced in order, so by then the node has discovered our subscriptions.
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
    """The declared topics by name; raises InputError for one that is not part of every set."""
    found = _topics("heard", declared, HEARD | {topic.name: topic for topic in PUBLISHED})
    for name in found:
        if any(name == topic.name for topic in PUBLISHED) and name not in HEARD:
            problem = f"{name} is not published with every set"
            raise InputError("heard", name, f"one of {', '.join(HEARD)}", problem)
    return found


def said_topics(declared: tuple[str | Topic, ...] | str) -> dict[str, Topic]:
    """The declared topics by name; raises InputError for one that is not a command."""
    return _topics("said", declared, {topic.name: topic for topic in COMMANDS})


def _topics(field: str, declared, known: dict[str, Topic]) -> dict[str, Topic]:
    found = {}
    for each in (declared,) if isinstance(declared, str | Topic) else declared:
        if not isinstance(each, Topic) and each not in known:
            raise unknown_name(each, known, field)
        topic = each if isinstance(each, Topic) else known[each]
        found[topic.name] = topic
    if not found:
        raise InputError(field, declared, "one or more topics")
    return found


def message_of(topic: Topic, data):
    """A message with a number or an array as its data; raises InputError if `data` does not fit.

    Values are not checked here: the simulator drops or limits them, and reports it.
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
    """The Python type of the elements of a message field."""
    if "boolean" in field:
        return bool
    return float if "float" in field or "double" in field else int


def run(kind: type[Controller]) -> None:
    """Run a controller of this class until SIGINT or SIGTERM, which end it with status 0.

    The first line of its module's docstring is its description in --help.
    """
    about = (sys.modules[kind.__module__].__doc__ or "").partition("\n")[0]

    def body(_) -> int:
        controller = kind()
        refuse_unknown_parameters(controller)
        with lifetime(controller):
            controller.run()
        return 0

    usage = "%(prog)s [-h] [--ros-args -p NAME:=VALUE ...]"
    sys.exit(node_main(OneLineParser(description=about, usage=usage), body, sys.argv))
