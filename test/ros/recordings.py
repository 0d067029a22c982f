"""Bags, read by a library that did not write them."""

from pathlib import Path

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory


def read_bag(folder: Path) -> dict[str, list]:
    """The decoded messages of a bag by topic."""
    messages = {}
    with next(folder.glob("*.mcap")).open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        for _, channel, _, message in reader.iter_decoded_messages():
            messages.setdefault(channel.topic, []).append(message)
    return messages
