"""A rosbag2 bag (MCAP) that takes messages as they come, through the library rosbags."""

from pathlib import Path

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

from vehicle_roll_sim.declaration import InputError

BAG_VERSION = 9
NO_DEADLINE = QosTime(9223372036, 854775807)
"""The longest time there is: no deadline, no lifespan, no lease."""


def open_bag(folder: Path) -> Writer:
    """A new bag; raises InputError naming --output if it cannot be made."""
    try:
        bag = Writer(folder, version=BAG_VERSION, storage_plugin=StoragePlugin.MCAP)
        bag.open()
    except WriterError:
        raise InputError("--output", str(folder), "a folder that does not exist yet") from None
    except OSError as error:
        raise InputError("--output", "", "a folder that can be made", str(error)) from None
    return bag


def add_topic(bag: Writer, name: str, kind: type, offered: QoSProfile):
    """A connection for serialised messages of a ROS message class, with its definition."""
    package = kind.__module__.partition(".")[0]
    return bag.add_connection(
        name,
        f"{package}/msg/{kind.__name__}",
        typestore=get_typestore(Stores.ROS2_JAZZY),
        offered_qos_profiles=[bag_qos(offered)],
    )


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
