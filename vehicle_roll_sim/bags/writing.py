"""Writes serialized messages to a rosbag2 bag (MCAP) with the library rosbags."""

import contextlib
from collections.abc import Iterator
from pathlib import Path

from rosbags.interfaces import (
    Connection,
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import StoragePlugin, WriterError

from vehicle_roll_sim.bags.crash_safe_writer import CrashSafeWriter
from vehicle_roll_sim.bags.encoding import TYPES
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import new_folder
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.messages.topics import SIMULATION_DESCRIPTION

BAG_VERSION = 9
NO_DEADLINE = QosTime(9223372036, 854775807)
"""The largest representable duration: no deadline, no lifespan, no lease."""


class Bag:
    """A new bag; raises InputError naming `field` if it cannot be created."""

    def __init__(self, folder: Path, field: str):
        try:
            self._writer = CrashSafeWriter(
                folder, version=BAG_VERSION, storage_plugin=StoragePlugin.MCAP
            )
            self._writer.open()
        except WriterError:
            raise InputError(field, str(folder), "a folder that does not exist yet") from None
        except OSError as error:
            raise InputError(field, "", "a folder that can be created", str(error)) from None

    def add_topic(self, topic: Topic, name: str) -> Connection:
        """Add a connection for serialized messages of a topic, under its full name."""
        qos = [_offered(topic)]
        return self._writer.add_connection(
            name, topic.type, typestore=TYPES, offered_qos_profiles=qos
        )

    def write(self, connection: Connection, time_ns: int, data: bytes) -> None:
        """Write a serialized message, logged at `time_ns`."""
        self._writer.write(connection, time_ns, data)

    def begin(self) -> None:
        """Make the bag readable, now and after every `keep`. Add all topics before."""
        self._writer.begin()

    def keep(self) -> None:
        """Flush everything written so far to disk, in case the process is killed."""
        self._writer.keep()

    def describe(self, simulation: str) -> None:
        """Store the description of the simulation (simulation.description) in the metadata."""
        self._writer.set_custom_data(SIMULATION_DESCRIPTION.name, simulation)

    @property
    def message_count(self) -> int:
        """The number of messages written."""
        return sum(self._writer.counts.values())

    def close(self) -> None:
        """Write the index and the metadata, unless the bag was aborted."""
        if self._writer.storage:
            self._writer.close()

    def abort(self) -> None:
        """Close the files without finishing them."""
        self._writer.abort()


@contextlib.contextmanager
def whole_bag(folder: Path, field: str) -> Iterator[Bag]:
    """A bag to write to; it appears at `folder` when complete, or not at all."""
    with new_folder(folder, field) as partial:
        bag = Bag(partial, field)
        try:
            yield bag
        except BaseException:
            bag.abort()
            raise
        bag.close()


def _offered(topic: Topic) -> Qos:
    """The QoS profile of a topic for the metadata of a bag."""
    return Qos(
        history=QosHistory.KEEP_LAST,
        depth=topic.depth,
        reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL if topic.latched else QosDurability.VOLATILE,
        deadline=NO_DEADLINE,
        lifespan=NO_DEADLINE,
        liveliness=QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=NO_DEADLINE,
        avoid_ros_namespace_conventions=False,
    )
