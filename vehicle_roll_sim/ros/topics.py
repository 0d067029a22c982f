"""The topics of the package in terms of ROS: message classes and qualities of service."""

import importlib
import importlib.util

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from vehicle_roll_sim.messages.topics import COMMANDS, Topic

NEWEST_ONLY = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
"""Of the command subscriptions: any publisher connects, and only its newest message counts."""
EVERY_ANSWER = QoSProfile(depth=1)
"""Of the command subscriptions in lockstep: reliable, so that no answer is lost."""
COMMANDING = QoSProfile(depth=1)
"""Of what publishes commands."""


def is_installed(topic: Topic) -> bool:
    """Whether there are messages of its type: a minimal ROS has no tf2_msgs."""
    return importlib.util.find_spec(topic.type.partition("/")[0]) is not None


def message_class(type_name: str) -> type:
    """The class of a type such as "std_msgs/msg/Float64"."""
    package, _, name = type_name.partition("/msg/")
    return getattr(importlib.import_module(f"{package}.msg"), name)


def offered_qos(topic: Topic) -> QoSProfile:
    """Of a publisher."""
    return QoSProfile(depth=topic.depth, durability=_durability(topic))


def recording_qos(topic: Topic) -> QoSProfile:
    """For a subscription that wants every message of any publisher of the topic."""
    is_command = topic in COMMANDS
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=1000,
        reliability=ReliabilityPolicy.BEST_EFFORT if is_command else ReliabilityPolicy.RELIABLE,
        durability=_durability(topic),
    )


def _durability(topic: Topic) -> DurabilityPolicy:
    return DurabilityPolicy.TRANSIENT_LOCAL if topic.latched else DurabilityPolicy.VOLATILE
