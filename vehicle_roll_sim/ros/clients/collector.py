"""Collects what a running simulator publishes, from its last reset on."""

from collections.abc import Callable

from rclpy.node import Node

from vehicle_roll_sim.messages.run_messages import (
    COLLECTED,
    NOT_OF_EVERY_MODEL,
    STATE,
    RunMessages,
    by_name,
    is_ours,
)
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.ros.qos_overrides import make_subscription
from vehicle_roll_sim.ros.topics import message_class, recording_qos
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.road import Road

NUMBER = "publication_sequence_number"
"""Key in the message info: the publisher's count of its messages, starting at 1."""


class Collector:
    """Subscribes to the sets of a simulator and ignores messages that cannot come from one.

    subscriptions: to the topics that every simulator publishes. on_state: called with every `state`
    kept, as a dict by name. is_mixed: whether the sequence numbers show that messages on one topic
    since the last `forget` came from two publishers.
    """

    def __init__(self, node: Node, on_state: Callable[[dict], None]):
        self._on_state = on_state

        def subscription(topic: Topic):
            kind, listen = message_class(topic.type), self._listener(topic.name)
            return make_subscription(node, kind, topic.name, listen, recording_qos(topic))

        self.subscriptions = [subscription(topic) for topic in COLLECTED]
        self._further = [subscription(topic) for topic in NOT_OF_EVERY_MODEL]
        self.forget()

    def forget(self) -> None:
        """Drop everything, and wait for the state at time 0 that follows a reset."""
        self._kept = RunMessages()
        self.is_mixed, self._numbers = False, {}

    def _listener(self, name: str):
        def listen(message, info: dict) -> None:
            if not is_ours(name, message):
                return
            self._note_number(name, info.get(NUMBER))
            if name == STATE:
                self._keep_state(by_name(message), info["source_timestamp"])
            else:
                self._kept.keep(name, info["source_timestamp"], message)

        return listen

    def _note_number(self, name: str, number: int | None) -> None:
        """Detect a second publisher: sequence numbers of one only increase.

        Not every middleware provides these numbers.
        """
        if number is None:
            return
        self.is_mixed = self.is_mixed or number <= self._numbers.get(name, 0)
        self._numbers[name] = number

    def simulators(self) -> int:
        """The number of known nodes that publish every topic of a simulator."""
        return min(each.get_publisher_count() for each in self.subscriptions)

    def _keep_state(self, state: dict, sent: int) -> None:
        if state["time"] == 0.0:
            self._kept.states.clear()
        elif not self._kept.states:
            return
        self._kept.states.append((sent, state))
        self._on_state(state)

    def is_complete(self) -> bool:
        """Whether all messages of the last set have arrived."""
        return self._kept.is_complete()

    def history(self, road: Road) -> History:
        """One row for every complete set (`RunMessages.history`)."""
        return self._kept.history(road)
