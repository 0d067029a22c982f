"""Bags: being recorded, and read by a library that did not write them."""

from collections import Counter
from pathlib import Path

import pytest


def read_bag(folder: Path) -> dict[str, list]:
    """The decoded messages of a bag by topic."""
    reason = "mcap-ros2-support, which reads bags, is not installed"
    make_reader = pytest.importorskip("mcap.reader", reason=reason).make_reader
    DecoderFactory = pytest.importorskip("mcap_ros2.decoder", reason=reason).DecoderFactory
    messages = {}
    with next(folder.glob("*.mcap")).open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        for _, channel, _, message in reader.iter_decoded_messages():
            messages.setdefault(channel.topic, []).append(message)
    return messages


def heard_so_far(folder: Path) -> Counter[str]:
    """How many messages of each topic a recorder has in its bag, which need not be closed.

    Middlewares can take seconds until a late recorder hears a topic that is known to everybody.
    """
    from rosbags.rosbag2 import ReaderError  # there is none without the recorder's library

    from vehicle_roll_sim.bags.unindexed_reader import BagReader

    try:
        with BagReader(folder) as reader:
            return Counter(connection.topic for connection, _, _ in reader.messages())
    except (FileNotFoundError, ReaderError):  # it has not begun
        return Counter()
