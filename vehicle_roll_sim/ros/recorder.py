"""The node `recorder`: writes every topic of the package into a rosbag2 bag (MCAP)."""

import argparse
import sys
import time
from pathlib import Path
from types import ModuleType

from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.ros.process import node_main
from vehicle_roll_sim.ros.topics import COMMANDING, COMMANDS, PUBLISHED, Topic, recording_qos

SHORTEST_RECORDING, LONGEST_RECORDING = 0.1, 1e6
"""s"""


class Recorder(Node):
    """Subscribes to every topic in its namespace; the serialised bytes go into the bag as they are.

    Messages bear the time at which they were sent; latched ones, which may be much older than the
    recording, that at which they came.
    """

    def __init__(self, bags: ModuleType, bag):
        super().__init__("recorder")
        self._bags, self._bag = bags, bag
        for topic in (*COMMANDS, *PUBLISHED):
            self._record(topic)

    def _record(self, topic: Topic) -> None:
        offered = COMMANDING if topic in COMMANDS else topic.publisher_qos
        name = self.resolve_topic_name(topic.name)
        connection = self._bags.add_topic(self._bag, name, topic.type, offered)
        clock = "received_timestamp" if topic.latched else "source_timestamp"

        def write(data: bytes, info: dict) -> None:
            self._bag.write(connection, info[clock], data)

        self.create_subscription(topic.type, topic.name, write, recording_qos(topic), raw=True)


def record(folder: Path, duration: float | None) -> int:
    """Record until interrupted or for `duration` (wall seconds); the exit status."""
    bags = _bags()
    bag = bags.open_bag(folder)
    try:
        executor = SingleThreadedExecutor()
        executor.add_node(Recorder(bags, bag))
        print(f"recorder: recording to {folder}", flush=True)
        until = time.monotonic() + duration if duration else float("inf")
        while (left := until - time.monotonic()) > 0.0:
            executor.spin_once(timeout_sec=min(1.0, left))
    finally:
        bag.close()
        print(f"recorder: {sum(bag.counts.values())} messages in {folder}", flush=True)
    return 0


def _bags() -> ModuleType:
    """The module that writes bags, whose library is optional."""
    try:
        from vehicle_roll_sim.ros import bag
    except ModuleNotFoundError as error:
        wanted = "pip install rosbags, or record with ros2 bag"
        raise InputError("recorder", "", wanted, f"no Python package {error.name}") from None
    return bag


def main() -> int:
    """Entry point of the executable."""
    parser = OneLineParser(
        prog="recorder",
        description="Record every topic of a simulator, commands included, into a rosbag2 bag.",
    )
    parser.add_argument("--output", required=True, metavar="DIR", help="the bag; must not exist")
    parser.add_argument("--duration", metavar="S", help="wall time; until interrupted if not given")

    def body(arguments: argparse.Namespace) -> int:
        return record(Path(arguments.output), _duration(arguments.duration))

    return node_main(parser, body, sys.argv)


def _duration(text: str | None) -> float | None:
    if text is None:
        return None
    allowed = f"a number from {SHORTEST_RECORDING:g} to {LONGEST_RECORDING:g} s"
    try:
        seconds = float(text)
    except ValueError:
        raise InputError("--duration", text, allowed) from None
    if not SHORTEST_RECORDING <= seconds <= LONGEST_RECORDING:
        raise InputError("--duration", seconds, allowed)
    return seconds


if __name__ == "__main__":
    sys.exit(main())
