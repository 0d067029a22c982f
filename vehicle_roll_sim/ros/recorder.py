"""The node `recorder`: writes every topic of the package into a rosbag2 bag (MCAP)."""

import argparse
import sys
import time
from pathlib import Path

from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import StoragePlugin, Writer, WriterError
from rosbags.typesys import Stores, get_typestore

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.ros.process import node_main
from vehicle_roll_sim.ros.topics import COMMANDING, COMMANDS, PUBLISHED, Topic, recording_qos

BAG_VERSION = 9
NO_DEADLINE = QosTime(9223372036, 854775807)
"""The longest time there is: no deadline, no lifespan, no lease."""
LONGEST_RECORDING = 1e6
"""s"""


class Recorder(Node):
    """Subscribes to every topic in its namespace; the serialised bytes go into the bag as they are.

    Messages bear the time at which they were sent; latched ones, which may be much older than the
    recording, that at which they came.
    """

    def __init__(self, bag: Writer):
        super().__init__("recorder")
        self._bag = bag
        self._types = get_typestore(Stores.ROS2_JAZZY)
        self.count = 0
        for topic in (*COMMANDS, *PUBLISHED):
            self._record(topic)

    def _record(self, topic: Topic) -> None:
        package, name = topic.type.__module__.partition(".")[0], topic.type.__name__
        offered = COMMANDING if topic in COMMANDS else topic.publisher_qos
        connection = self._bag.add_connection(
            self.resolve_topic_name(topic.name),
            f"{package}/msg/{name}",
            typestore=self._types,
            offered_qos_profiles=[bag_qos(offered)],
        )
        clock = "received_timestamp" if topic.latched else "source_timestamp"

        def write(data: bytes, info: dict) -> None:
            self._bag.write(connection, info[clock], data)
            self.count += 1

        self.create_subscription(topic.type, topic.name, write, recording_qos(topic), raw=True)


def bag_qos(profile: QoSProfile) -> Qos:
    """A quality of service as a bag's metadata has it."""
    latched = profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    return Qos(
        history=QosHistory.KEEP_LAST,
        depth=profile.depth,
        reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL if latched else QosDurability.VOLATILE,
        deadline=NO_DEADLINE,
        lifespan=NO_DEADLINE,
        liveliness=QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=NO_DEADLINE,
        avoid_ros_namespace_conventions=False,
    )


def record(output: Path, duration: float | None) -> int:
    """Record until interrupted or for `duration` (wall seconds); the exit status."""
    try:
        bag = Writer(output, version=BAG_VERSION, storage_plugin=StoragePlugin.MCAP)
        bag.open()
    except WriterError:
        raise InputError("--output", str(output), "a folder that does not exist yet") from None
    except OSError as error:
        raise InputError("--output", "", "a folder that can be made", str(error)) from None
    recorder = Recorder(bag)
    executor = SingleThreadedExecutor()
    executor.add_node(recorder)
    try:
        print(f"recorder: recording to {output}", flush=True)
        until = time.monotonic() + duration if duration else float("inf")
        while (left := until - time.monotonic()) > 0.0:
            executor.spin_once(timeout_sec=min(1.0, left))
    finally:
        bag.close()
        print(f"recorder: {recorder.count} messages in {output}", flush=True)
    return 0


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
    allowed = f"a number from 0.1 to {LONGEST_RECORDING:g} s"
    try:
        seconds = float(text)
    except ValueError:
        raise InputError("--duration", text, allowed) from None
    if not 0.1 <= seconds <= LONGEST_RECORDING:
        raise InputError("--duration", seconds, allowed)
    return seconds


if __name__ == "__main__":
    sys.exit(main())
