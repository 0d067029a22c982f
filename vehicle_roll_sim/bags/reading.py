"""Reads the runs of a simulator from a bag written by rosbag2, this package or other libraries."""

import dataclasses
import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from rosbags.rosbag2 import Reader

from vehicle_roll_sim.bags.encoding import decode
from vehicle_roll_sim.bags.unindexed_reader import BagReader
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.messages.run_messages import (
    COLLECTED,
    COMMAND,
    NOT_OF_EVERY_MODEL,
    STATE,
    TIRE_FORCES,
    RunMessages,
    by_name,
    is_ours,
)
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.messages.topics import MEASUREMENTS, SIMULATION_DESCRIPTION
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.description import Described, described
from vehicle_roll_sim.simulation.road import Road

A_BAG = "a complete bag of a simulator: metadata.yaml and the file that it names"
READ = (*COLLECTED, *NOT_OF_EVERY_MODEL, MEASUREMENTS, SIMULATION_DESCRIPTION)


@dataclasses.dataclass
class RecordedRun:
    """What was recorded from one reset to the next.

    description: of the simulation (simulation.description), '' if the bag has none. commands,
    measurements: the values of `applied_command` and of `measurements` by the time of their set
    (s).
    """

    description: str
    kept: RunMessages = dataclasses.field(default_factory=RunMessages)
    commands: dict[float, np.ndarray] = dataclasses.field(default_factory=dict)
    measurements: dict[float, np.ndarray] = dataclasses.field(default_factory=dict)

    @property
    def states(self) -> list[dict[str, float]]:
        """Every `state` as a dict by name, in order."""
        return [state for _, state in self.kept.states]

    @property
    def begins_at_a_reset(self) -> bool:
        """Whether the recording includes time 0."""
        return self.states[0]["time"] == 0.0

    def keep(self, topic: str, sent: int, message) -> None:
        """Add a message of a topic other than `state`. sent: when it was sent (ns)."""
        if topic == MEASUREMENTS.name:
            self.measurements[float(message.data[0])] = message.data[1:]
            return
        self.kept.keep(topic, sent, message)
        if topic == COMMAND:
            self.commands[float(message.data[0])] = message.data


def recorded_runs(
    path: Path, namespace: str | None = None, further: Sequence[Topic] = ()
) -> list[RecordedRun]:
    """The runs in a bag, in order. namespace: of the vehicle, required if the bag has several.

    further: topics to read besides READ. Raises InputError if `path` is not a bag, is damaged, or
    has no states or no commands.
    """
    runs = list(_runs(path, namespace, (*READ, *further)))
    for name, found in ((STATE, "states"), (COMMAND, "commands")):
        if not any(getattr(run, found) for run in runs):
            raise InputError("BAG", str(path), A_BAG, f"{path}: no messages on {name}")
    return runs


def last_run(
    path: Path, namespace: str | None = None, with_forces: bool = False
) -> tuple[History, Described | None]:
    """The samples of the last run in a bag, and its description; without one, the road is level.

    with_forces: read the horizontal tire forces too, which takes a quarter longer. Raises
    the InputErrors of `recorded_runs` and `described`, and one if no set is complete.
    """
    run = recorded_runs(path, namespace, TIRE_FORCES if with_forces else ())[-1]
    told = described(run.description) if run.description else None
    history = run.kept.history(told.simulation.road if told else Road())
    if not len(history.rows):
        wanted = ", ".join(topic.name for topic in COLLECTED)
        raise InputError("BAG", str(path), f"complete sets of {wanted}", f"{path}: no complete set")
    return history, told


def _runs(path: Path, namespace: str | None, topics: Sequence[Topic]) -> Iterator[RecordedRun]:
    """Every run; a new one begins when the time of the states decreases.

    Messages logged before the first state may belong to it: receivers log in order of arrival.
    """
    run, early, last_time, description = None, [], math.inf, ""
    for topic, sent, message in _messages(path, namespace, topics):
        _check(topic, message, path)
        if topic is SIMULATION_DESCRIPTION:
            description = message.data
            if run is not None and not run.description:
                run.description = description
        elif topic.name == STATE:
            state = by_name(message)
            if state["time"] < last_time:
                if run is not None:
                    yield run
                run = RecordedRun(description)
                for entry in early:
                    run.keep(*entry)
                early = []
            last_time = state["time"]
            run.kept.states.append((sent, state))
        elif run is None:
            early.append((topic.name, sent, message))
        else:
            run.keep(topic.name, sent, message)
    if run is not None:
        yield run


def _check(topic: Topic, message, path: Path) -> None:
    """Raise InputError for a message that cannot come from a simulator."""
    if not is_ours(topic.name, message):
        problem = f"{path}: a message on {topic.name} that is not a simulator's"
        raise InputError("BAG", str(path), A_BAG, problem)


def _messages(
    path: Path, namespace: str | None, topics: Sequence[Topic]
) -> Iterator[tuple[Topic, int, object]]:
    """Topic, log time (ns) and message of everything on these topics of a vehicle in the bag."""
    if not path.is_dir():
        raise InputError("BAG", str(path), A_BAG)
    try:
        with BagReader(path) as reader:
            names = _names(reader, path, namespace, topics)
            wanted = [each for each in reader.connections if each.topic in names]
            for connection, sent, data in reader.messages(wanted):
                topic = names[connection.topic]
                yield topic, sent, decode(data, topic.type)
    except InputError:
        raise
    except Exception as error:  # the library raises all sorts of errors for a damaged file
        reason = getattr(error, "strerror", None) or error or type(error).__name__
        raise InputError("BAG", str(path), A_BAG, f"{path}: {reason}") from None


def _names(
    reader: Reader, path: Path, namespace: str | None, topics: Sequence[Topic]
) -> dict[str, Topic]:
    """These topics, by their full names in the bag; raises InputError."""
    types = {connection.topic: connection.msgtype for connection in reader.connections}
    suffix = f"/{COMMAND}"
    found = sorted(name.removesuffix(suffix) for name in types if name.endswith(suffix))
    if not found:
        raise InputError("BAG", str(path), A_BAG, f"{path}: no topic {COMMAND}")
    chosen = found
    if namespace is not None:
        chosen = [name for name in found if name.strip("/") == namespace.strip("/")]
    if len(chosen) != 1:
        allowed = "one of " + ", ".join(name or "/" for name in found)
        raise InputError("--namespace", namespace, f"{allowed}, the vehicles in {path}")
    names = {f"{chosen[0]}/{topic.name}": topic for topic in topics}
    for name, topic in names.items():
        if name in types and types[name] != topic.type:
            raise InputError(f"{path}: {name}", types[name], topic.type)
    return names
