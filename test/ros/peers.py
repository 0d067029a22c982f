"""Other processes and nodes for the tests: a simulator, and a node that communicates with it."""

import os
import signal
import subprocess
import sys
import time
from array import array

import rclpy
from fork_server import EXECUTABLES
from forked import open_process
from patience import PATIENCE
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from vehicle_roll_sim.messages.command_topics import COMMANDS, WAYS_IN
from vehicle_roll_sim.messages.topics import PUBLISHED, STAMPED
from vehicle_roll_sim.ros.topics import COMMANDING, message_class, recording_qos

ASK_AGAIN = 5.0
"""Seconds after which a service is asked again."""
RACE_FOR_A_PORT = "RTPS_TRANSPORT_SHM Error"
"""Fast DDS says so where another process, of whatever domain, has just taken the port of shared
memory that it wanted. It takes the next one."""
EVERY_STATE = "qos_overrides./state.publisher.depth:=1000"
"""A simulator that catches up sends some ten sets at once, as many as its queues hold by default:
a peer that is held up just then would miss one."""
TOPICS = {topic.name: topic for topic in (*COMMANDS, *WAYS_IN, *PUBLISHED, *STAMPED)}


class Peer:
    """A node in a context of its own that listens, publishes and calls services."""

    def __init__(self, domain: int, namespace: str = ""):
        self.context = Context()
        rclpy.init(context=self.context, domain_id=domain)
        self.node = Node("peer", context=self.context, namespace=namespace)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.received: dict[str, list] = {}
        self._publishers = {}
        self._subscriptions, self._clients = {}, {}

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.try_shutdown(context=self.context)

    def spin(self) -> None:
        self.executor.spin_once(timeout_sec=0.05)

    def wait(self, done, what: str):
        """Spin until `done()` is true; returns its value. Fails, naming `what`, if that lasts."""
        until = time.monotonic() + PATIENCE
        while not (value := done()):
            assert time.monotonic() < until, f"waited {PATIENCE} s in vain for {what}"
            self.spin()
        return value

    def listen(self, *names: str) -> None:
        """Subscribe, and wait until the publishers are matched."""
        for name in names:
            self.received[name] = []
            topic = TOPICS[name]

            def keep(message, info, kept=self.received[name]):
                kept.append((info["source_timestamp"], message))

            self._subscriptions[name] = self.node.create_subscription(
                message_class(topic.type), name, keep, recording_qos(topic)
            )
        for name in names:
            self.wait(self._subscriptions[name].get_publisher_count, f"a publisher on {name}")

    def wait_for_listener(self, name: str, node: str) -> None:
        """Until the node of that name listens to a topic."""
        topic = self.node.resolve_topic_name(name)
        self.wait(
            lambda: any(
                listener.node_name == node
                for listener in self.node.get_subscriptions_info_by_topic(topic)
            ),
            f"{node} on {topic}",
        )

    def newest(self, name: str):
        """Wait for a message of a topic that is received from now on, whenever it was sent."""
        count = len(self.received[name])
        self.wait(lambda: len(self.received[name]) > count, f"a message on {name}")
        return self.received[name][-1][1]

    def current(self, name: str):
        """Wait for a message of a topic that is sent from now on; others may be on their way."""
        received, now = self.received[name], time.time_ns()
        self.wait(lambda: received and received[-1][0] >= now, f"a message on {name}")
        return received[-1][1]

    def publisher(self, name: str):
        """A publisher that is matched."""
        if name not in self._publishers:
            self._publishers[name] = self.node.create_publisher(
                message_class(TOPICS[name].type), name, COMMANDING
            )
        publisher = self._publishers[name]
        self.wait(publisher.get_subscription_count, f"a subscriber of {name}")
        return publisher

    def publish(self, name: str, value) -> None:
        self.publisher(name).publish(message_of(name, value))

    def command(self, values: dict, done, what: str):
        """Publish commands, by topic, over and over until `done()` is true, as a controller does.

        One message alone may come before a best-effort subscription knows of its publisher.
        """

        def sent_and_done():
            for name, value in values.items():
                self.publish(name, value)
            return done()

        return self.wait(sent_and_done, what)

    def call(self, kind, name: str, request=None):
        """Call a service and wait for the answer; ask again if it is long in coming.

        A server that has not found its new client yet drops the answer. A step is asked for once.
        """
        client = self._client(kind, name)
        self.wait(client.service_is_ready, f"the service {name}")
        asked = []

        def answered():
            is_new = not asked or time.monotonic() > asked[-1][0] + ASK_AGAIN
            if is_new and not (asked and name.endswith("/step")):
                asked.append((time.monotonic(), client.call_async(request or kind.Request())))
            return next((future for _, future in asked if future.done()), None)

        return self.wait(answered, f"an answer of {name}").result()

    def _client(self, kind, name: str):
        if name not in self._clients:
            self._clients[name] = self.node.create_client(kind, name)
        return self._clients[name]


def message_of(name: str, value):
    """A command message with `value` as its data, unless it is a message itself."""
    if hasattr(value, "get_fields_and_field_types"):
        return value
    data = value if isinstance(value, float) else array("d", value)
    return message_class(TOPICS[name].type)(data=data)


def sets_of(received: dict[str, list], *names: str) -> list[dict]:
    """The complete sets of a recording: whatever was sent between two states is one."""
    events = sorted(
        (sent, name, message) for name in ("state", *names) for sent, message in received[name]
    )
    sets = []
    for _, name, message in events:
        if name == "state":
            sets.append({})
        if sets:
            sets[-1][name] = message
    return [found for found in sets if len(found) == len(names) + 1]


class Process:
    """An executable of the package, or a script, as a process of its own, ended by its id.

    fresh: started from scratch, not forked from a process that has imported everything. A process
    with another environment always is.
    """

    def __init__(
        self, domain: int, module: str, *words: str, program: str | None = None, fresh: bool = False
    ):
        environment = os.environ | {"ROS_DOMAIN_ID": str(domain)}
        command = [program] if program else ["-m", EXECUTABLES, module]
        self.process = open_process(
            [sys.executable, *command, *words],
            env=environment,
            fresh=fresh,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )

    def finish(self, signum: int | None = None) -> tuple[int, str, str]:
        """Wait for the end, after a signal if one is given: exit status, stdout, stderr."""
        if signum is not None:
            self.process.send_signal(signum)
        out, err = self.process.communicate(timeout=PATIENCE)
        own = [line for line in err.splitlines(keepends=True) if RACE_FOR_A_PORT not in line]
        return self.process.returncode, out, "".join(own)

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
            try:
                self.process.communicate(timeout=PATIENCE)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.communicate()
