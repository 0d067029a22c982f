"""The node `recorder`: records every topic of the package into a rosbag2 bag (MCAP)."""

import argparse
import contextlib
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

from rclpy.callback_groups import CallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rclpy.subscription import Subscription

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.input_errors import number_within
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.messages.topics import PUBLISHED, SIMULATION_DESCRIPTION, STAMPED
from vehicle_roll_sim.ros import signals
from vehicle_roll_sim.ros.node_main import lifetime, node_main, refuse_unknown_parameters
from vehicle_roll_sim.ros.qos_overrides import make_subscription, refuse_wrong_overrides
from vehicle_roll_sim.ros.topics import heard_commands, is_installed, message_class, recording_qos

SHORTEST_RECORDING, LONGEST_RECORDING = 0.1, 1e6
"""s"""
KEPT_EVERY = 0.5
"""Interval (s) at which messages are flushed to disk, in case the recorder is killed."""
TAKEN_EVERY = 0.01
"""Interval (s) at which subscriptions are polled."""
LAST_LOOK, LONGEST_LAST_LOOK = 0.1, 0.5
"""Time (s) to read on at the end: until nothing arrives for the first, at most the second."""
MOST_AT_ONCE = 1000
"""Messages read from a topic before the next topic has its turn."""


class Untouched(CallbackGroup):
    """A callback group whose subscriptions the executor ignores."""

    def can_execute(self, entity) -> bool:
        return False

    def beginning_execution(self, entity) -> bool:
        return False

    def ending_execution(self, entity) -> None:
        """Nothing to end."""


class Recorder(Node):
    """Subscribes to every topic in its namespace, and writes the serialized bytes to the bag as is.

    Messages are logged at the time at which they were sent, but latched ones, which may be much
    older than the recording, at the time at which they were received.
    """

    def __init__(self):
        super().__init__("recorder")
        refuse_unknown_parameters(self)
        published = filter(is_installed, (*PUBLISHED, *STAMPED))
        self._topics = [*heard_commands(), *published]
        refuse_wrong_overrides(self, subscriptions=[topic.name for topic in self._topics])
        self._untouched = Untouched()

    def begin(self, bag) -> None:
        """Create the subscriptions; `take` then writes to this bag."""
        connections = {
            topic: bag.add_topic(topic, self.resolve_topic_name(topic.name))
            for topic in self._topics
        }
        bag.begin()
        self._writing = [self._record(bag, *each) for each in connections.items()]

    def take(self) -> None:
        """Write all messages that have arrived.

        An executor would check every subscription before each message, which takes ten times as
        long.
        """
        for subscription, write in self._writing:
            for _ in range(MOST_AT_ONCE):
                taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
                if taken is None:
                    break
                write(*taken)

    def _record(self, bag, topic: Topic, connection) -> tuple[Subscription, Callable]:
        """A subscription, and the function that writes its messages."""
        kind = message_class(topic.type)
        clock = "received_timestamp" if topic.latched else "source_timestamp"

        def write(data: bytes, info: dict) -> None:
            bag.write(connection, info[clock], data)
            if topic is SIMULATION_DESCRIPTION:
                bag.describe(deserialize_message(data, kind).data)

        subscription = make_subscription(
            self,
            kind,
            topic.name,
            write,
            recording_qos(topic),
            callback_group=self._untouched,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
            raw=True,
        )
        return subscription, write


def record(folder: Path, duration: float | None) -> int:
    """Record until interrupted, or for `duration` (wall s); return the exit status."""
    need_library("--output")
    from vehicle_roll_sim.bags.writing import Bag  # its library is optional

    recorder = Recorder()
    bag = Bag(folder, "--output")
    try:
        with lifetime(recorder) as executor:
            recorder.begin(bag)
            _say(f"recording to {folder}")
            _listen(recorder, executor, bag, duration)
            _read_on(recorder, bag)
    except OSError:  # a full disk: what has been written can be read
        bag.abort()
        raise
    finally:
        bag.close()
        _say(f"{bag.message_count} messages in {folder}")
    return 0


def _say(text: str) -> None:
    """Print a line; recording must go on even if nobody reads it."""
    with contextlib.suppress(OSError):
        print(f"recorder: {text}", flush=True)


def _listen(recorder: Recorder, executor: Executor, bag, duration: float | None) -> None:
    """Record until a signal arrives, or for `duration` (s)."""
    ended = threading.Event()

    def end() -> None:
        ended.set()
        executor.wake()

    signals.shut_down_on_signal(end)
    now = time.monotonic()
    until, keep_at = now + duration if duration else float("inf"), now + KEPT_EVERY
    while not ended.is_set() and (now := time.monotonic()) < until:
        if now >= keep_at:
            bag.keep()
            keep_at = now + KEPT_EVERY
        executor.spin_once(timeout_sec=TAKEN_EVERY)
        recorder.take()


def _read_on(recorder: Recorder, bag) -> None:
    """Write messages that have not been read yet or are still in transit."""
    until, count = time.monotonic() + LONGEST_LAST_LOOK, -1
    while count < bag.message_count and time.monotonic() < until:
        count = bag.message_count
        time.sleep(LAST_LOOK)
        recorder.take()


def main() -> int:
    """Entry point of the executable."""
    parser = OneLineParser(
        prog="recorder",
        description="Record all topics of a simulator, including commands, into a rosbag2 bag.",
    )
    parser.add_argument(
        "--output", required=True, metavar="DIR", help="folder for the bag; must not exist yet"
    )
    parser.add_argument(
        "--duration", metavar="S", help="wall time to record for (default: until interrupted)"
    )

    def body(arguments: argparse.Namespace) -> int:
        return record(Path(arguments.output), _duration(arguments.duration))

    return node_main(parser, body, sys.argv)


def _duration(text: str | None) -> float | None:
    if text is None:
        return None
    return number_within(text, "--duration", SHORTEST_RECORDING, LONGEST_RECORDING, "s")


if __name__ == "__main__":
    sys.exit(main())
