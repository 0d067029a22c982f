"""Fields of messages in a bag as columns of numbers, whoever recorded them."""

from pathlib import Path

import numpy as np

from vehicle_roll_sim.bags.encoding import TYPES, decode
from vehicle_roll_sim.bags.unindexed_reader import BagReader
from vehicle_roll_sim.input_errors import InputError, unknown_name
from vehicle_roll_sim.model.integration.advance import NANOSECONDS

A_BAG = "a complete bag: metadata.yaml and the files that it names"
FORM = "TOPIC:FIELD, such as /imu:angular_velocity.z or /state:yaw_rate"
Columns = dict[str, tuple[np.ndarray, np.ndarray]]
"""Times (s) and values by column, shape (n,)."""


def read_topics(path: Path, fields: dict[str, str]) -> tuple[Columns, list[str]]:
    """The columns TOPIC:FIELD of a bag, and the topics whose times are those of the recorder.

    fields: names of the columns, and what messages call each. The time of a message is that of its
    header, or else that at which it was recorded. Elements of a multi-array have the names of its
    labels. Raises InputError.
    """
    wanted: dict[str, list[str]] = {}
    for name, field in fields.items():
        topic, colon, inside = name.partition(":")
        if not (colon and topic and inside):
            raise InputError(f"{field}: column", name, FORM)
        wanted.setdefault(topic, []).append(inside)
    found: dict[str, list[tuple[float, float]]] = {name: [] for name in fields}
    unstamped = set()
    try:
        with BagReader(path) as reader:
            connections = [each for each in reader.connections if each.topic in wanted]
            _check_topics(reader, connections, fields)
            for connection, sent, data in reader.messages(connections):
                message = decode(data, connection.msgtype)
                stamp = getattr(getattr(message, "header", None), "stamp", None)
                time = sent if stamp is None else stamp.sec * NANOSECONDS + stamp.nanosec
                if stamp is None:
                    unstamped.add(connection.topic)
                for inside in wanted[connection.topic]:
                    name = f"{connection.topic}:{inside}"
                    found[name].append((time, _value(message, inside, name, fields[name])))
    except InputError:
        raise
    except Exception as error:  # the library raises all sorts of errors for a damaged file
        reason = getattr(error, "strerror", None) or error or type(error).__name__
        raise InputError("LOG", str(path), A_BAG, f"{path}: {reason}") from None
    return {name: _arrays(pairs) for name, pairs in found.items()}, sorted(unstamped)


def _check_topics(reader: BagReader, connections: list, fields: dict[str, str]) -> None:
    """Raise InputError unless all topics are in the bag, with messages of known types."""
    there = {each.topic: each.msgtype for each in connections}
    for name, field in fields.items():
        topic = name.partition(":")[0]
        if topic not in there:
            every = sorted(each.topic for each in reader.connections)
            raise unknown_name(topic, every, f"{field}: column: topic")
        if there[topic] not in TYPES.fielddefs:
            raise InputError(f"{field}: column", there[topic], "a topic of a standard message type")


def _value(message, inside: str, name: str, field: str) -> float:
    """The number at a path of fields, or the element of a multi-array with a label."""
    here = message
    labels = [each.label for each in getattr(getattr(message, "layout", None), "dim", ())]
    if inside in labels:
        return float(message.data[labels.index(inside)])
    for part in inside.split("."):
        if not hasattr(here, part) or part.startswith("_"):
            known = [*labels, *getattr(here, "__dataclass_fields__", ())]
            raise unknown_name(part, known, f"{field}: column: {name}")
        here = getattr(here, part)
    if isinstance(here, bool) or not isinstance(here, int | float | np.number):
        raise InputError(f"{field}: column", name, "a field that is one number")
    return float(here)


def _arrays(pairs: list[tuple[float, float]]) -> tuple[np.ndarray, np.ndarray]:
    """Times from the integers of the bag (s), and values."""
    times = np.array([time for time, _ in pairs], np.int64)
    return times / NANOSECONDS, np.array([value for _, value in pairs])
