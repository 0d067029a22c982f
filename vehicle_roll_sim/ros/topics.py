"""The topics of the package in terms of ROS: message classes and QoS profiles."""

import importlib
import importlib.util

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from vehicle_roll_sim.messages.command_topics import COMMANDS, WAYS_IN
from vehicle_roll_sim.messages.topic import Topic

NEWEST_ONLY = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
"""For command subscriptions: compatible with any publisher, and keeps only the newest message."""
EVERY_ANSWER = QoSProfile(depth=10)
"""For command subscriptions in lockstep: no answer is lost, nor replaced by one that comes after it
before it was read."""
COMMANDING = QoSProfile(depth=1)
"""For command publishers."""
MOST_BEHIND = 1000
"""Messages by which a recorder may lag behind before any is lost."""


def is_installed(topic: Topic) -> bool:
    """Whether its message package is installed: a minimal ROS has no tf2_msgs."""
    return importlib.util.find_spec(topic.type.partition("/")[0]) is not None


def heard_commands() -> tuple[Topic, ...]:
    """The topics by which a simulator is commanded, as far as their types are installed."""
    return tuple(filter(is_installed, (*COMMANDS, *WAYS_IN)))


def message_class(type_name: str) -> type:
    """The message class of a type such as "std_msgs/msg/Float64"."""
    package, _, name = type_name.partition("/msg/")
    return getattr(importlib.import_module(f"{package}.msg"), name)


def offered_qos(topic: Topic, is_lossless: bool = False) -> QoSProfile:
    """The QoS profile with which this package publishes a topic.

    is_lossless: keep as many messages for a subscriber that lags behind as it keeps itself.
    """
    depth = MOST_BEHIND if is_lossless and not topic.latched else topic.depth
    return QoSProfile(depth=depth, durability=_durability(topic))


def recording_qos(topic: Topic) -> QoSProfile:
    """The QoS profile of a subscription that needs every message of any publisher."""
    is_command = topic in (*COMMANDS, *WAYS_IN)
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=MOST_BEHIND,
        reliability=ReliabilityPolicy.BEST_EFFORT if is_command else ReliabilityPolicy.RELIABLE,
        durability=_durability(topic),
    )


def _durability(topic: Topic) -> DurabilityPolicy:
    return DurabilityPolicy.TRANSIENT_LOCAL if topic.latched else DurabilityPolicy.VOLATILE
