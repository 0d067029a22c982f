"""A recorded run: the J-turn of the paper, which rolls over; and modified copies of it."""

import itertools
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def j_turn(tmp_path_factory) -> Path:
    """The bag of the J-turn, 85 degrees after 2.965 s."""
    from recorded import record  # in here: the tests are skipped where its libraries are missing

    folder = tmp_path_factory.mktemp("bags") / "j_turn"
    record(folder)
    return folder


@pytest.fixture
def changed(tmp_path):
    """changed(bag, change): a copy in which change(topic, ns, data) says what messages become.

    It gives a list of such triples for each message. Topics of the copy are those that come.
    """
    from rosbags.rosbag2 import Reader, StoragePlugin, Writer

    from vehicle_roll_sim.bags.encoding import TYPES

    numbers = itertools.count()

    def copy(bag: Path, change) -> Path:
        folder = tmp_path / f"changed_{next(numbers)}"
        with Reader(bag) as reader:
            types = {connection.topic: connection.msgtype for connection in reader.connections}
            messages = [
                (connection.msgtype, entry)
                for connection, sent, data in reader.messages()
                for entry in change(connection.topic, sent, data)
            ]
        with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
            connections = {}
            for kind, (topic, sent, data) in messages:
                if topic not in connections:
                    kind = types.get(topic, kind)
                    connections[topic] = writer.add_connection(topic, kind, typestore=TYPES)
                writer.write(connections[topic], sent, data)
        return folder

    return copy
