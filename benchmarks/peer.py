"""The counterpart of a measured simulator: a node in this process, in a ROS domain of its own."""

import contextlib
import time
from collections.abc import Callable

import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.serialization import deserialize_message

from vehicle_roll_sim.messages.command_topics import COMMANDS
from vehicle_roll_sim.messages.topics import PUBLISHED
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.ros.orchestration.domains import own_domain
from vehicle_roll_sim.ros.topics import COMMANDING, message_class, offered_qos

PATIENCE = 120.0
"""Timeout of a wait (s), long enough to compile the model on a busy machine."""
TURN = 0.02
"""Poll interval of a wait (s)."""
BATCH = 1000
"""Queue length of a Tap (messages)."""
TOPICS = {topic.name: topic for topic in (*COMMANDS, *PUBLISHED)}


def kind_of(name: str) -> type:
    """The message class of a topic."""
    return message_class(TOPICS[name].type)


def wait(done: Callable[[], object], what: str, turn: Callable[[], None]):
    """Call `turn` until `done()` is true and return its value.

    Raises TimeoutError naming `what` after PATIENCE.
    """
    until = time.monotonic() + PATIENCE
    while not (value := done()):
        if time.monotonic() > until:
            raise TimeoutError(f"timed out after {PATIENCE:g} s waiting for {what}")
        turn()
    return value


class Peer:
    """A node that subscribes and sends commands, with its executor; a context manager."""

    def __init__(self):
        self._own = contextlib.ExitStack()
        self.domain = self._own.enter_context(own_domain())
        self.context = Context()
        rclpy.init(context=self.context, domain_id=self.domain)
        self.node = Node("benchmark", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.try_shutdown(context=self.context)
        self._own.close()

    def listen(self, name: str, receive: Callable):
        return self.node.create_subscription(
            kind_of(name), name, receive, offered_qos(TOPICS[name])
        )

    def commander(self, name: str):
        return self.node.create_publisher(kind_of(name), name, COMMANDING)

    def spin(self, longest: float = TURN) -> None:
        self.executor.spin_once(timeout_sec=longest)

    def spin_for(self, duration: float) -> None:
        until = time.monotonic() + duration
        while (left := until - time.monotonic()) > 0.0:
            self.spin(min(left, TURN))

    def wait(self, done: Callable[[], object], what: str):
        return wait(done, what, self.spin)


class Tap:
    """All messages on a topic, taken in batches and not deserialized.

    With an executor, receiving a message would cost more than the simulator spends on sending it.
    The node must not be spun in the meantime. first, last: (bytes, message info) of the first and
    the last message; kept: those of all messages, if `keep` is set.
    """

    def __init__(self, peer: Peer, name: str, keep: bool = False):
        self.name, self.kind, self.keep = name, kind_of(name), keep
        self._subscription = peer.node.create_subscription(
            self.kind, name, lambda _: None, QoSProfile(depth=BATCH), raw=True
        )
        self.clear()

    def clear(self) -> None:
        self.count, self.first, self.last, self.kept = 0, None, None, []

    def drain(self) -> None:
        handle = self._subscription.handle
        with handle:
            while (taken := handle.take_message(self.kind, True)) is not None:
                self.first, self.last = self.first or taken, taken
                self.count += 1
                if self.keep:
                    self.kept.append(taken)

    @property
    def lost(self) -> int:
        """The number of messages sent between the first and the last received, but not received."""
        if not self.count:
            return 0
        first, last = (info["publication_sequence_number"] for _, info in (self.first, self.last))
        return last - first + 1 - self.count

    def decoded(self, taken: tuple):
        """The deserialized message, and when it was sent (s)."""
        data, info = taken
        return deserialize_message(data, self.kind), info["source_timestamp"] / NANOSECONDS

    def found(self) -> bool:
        """Whether any message has been received."""
        self.drain()
        return self.count > 0
