"""The runs of a simulator in a bag, whoever recorded it: rosbag2, this package, other libraries."""

import dataclasses
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from rosbags.rosbag2 import Reader, ReaderError
from rosbags.serde import SerdeError

from vehicle_roll_sim.bags.encoding import decode
from vehicle_roll_sim.bags.unindexed import BagReader
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.messages.collected import COLLECTED, COMMAND, STATE, Collected, by_name
from vehicle_roll_sim.messages.sets import COMMAND_LABELS
from vehicle_roll_sim.messages.topics import SIMULATION_DESCRIPTION
from vehicle_roll_sim.simulation.history import History

A_BAG = "a whole bag of a simulator: metadata.yaml, and the file that it names"
READ = (*COLLECTED, SIMULATION_DESCRIPTION)


@dataclasses.dataclass
class RecordedRun:
    """What was recorded from one reset to the next.

    description: what was simulated (simulation.description), '' where the bag does not say.
    commands: values of `applied_command` by the time of their set (s).
    """

    description: str
    kept: Collected = dataclasses.field(default_factory=Collected)
    commands: dict[float, np.ndarray] = dataclasses.field(default_factory=dict)

    @property
    def states(self) -> list[dict[str, float]]:
        """Every `state`, by name, in order."""
        return [state for _, state in self.kept.states]

    def history(self) -> History:
        return self.kept.history()


def recorded_runs(path: Path, namespace: str | None = None) -> list[RecordedRun]:
    """The runs in a bag, in order, of the vehicle in `namespace` (needed if there are several).

    Raises InputError for what is no bag, is damaged, or has no states and commands.
    """
    try:
        runs = list(_runs(path, namespace))
    except (ReaderError, SerdeError, OSError, KeyError) as error:
        reason = getattr(error, "strerror", None) or error
        problem = f"{path}: {reason}"
        raise InputError("BAG", str(path), A_BAG, problem) from None
    for name, found in ((STATE, "states"), (COMMAND, "commands")):
        if not any(getattr(run, found) for run in runs):
            raise InputError("BAG", str(path), A_BAG, f"{path}: no messages on {name}")
    return runs


def last_history(path: Path) -> History:
    """The samples of the last run in a bag; raises InputError as `recorded_runs` does."""
    history = recorded_runs(path)[-1].history()
    if not len(history.rows):
        wanted = ", ".join(topic.name for topic in COLLECTED)
        raise InputError("BAG", str(path), f"sets of {wanted}", f"{path}: no complete set")
    return history


def _runs(path: Path, namespace: str | None) -> Iterator[RecordedRun]:
    """Every run; one ends where the time of the states falls."""
    if not path.is_dir():
        raise InputError("BAG", str(path), A_BAG)
    with BagReader(path) as reader:
        names = _names(reader, path, namespace)
        wanted = [connection for connection in reader.connections if connection.topic in names]
        run, last_time, description = None, np.inf, ""
        for connection, sent, data in reader.messages(wanted) if wanted else ():
            topic = names[connection.topic]
            message = decode(data, topic.type)
            if topic is SIMULATION_DESCRIPTION:
                description = message.data
                if run is not None and not run.description:
                    run.description = description
                continue
            if topic.name == STATE:
                state = by_name(message)
                if state["time"] < last_time:
                    if run:
                        yield run
                    run = RecordedRun(description)
                last_time = state["time"]
                run.kept.states.append((sent, state))
            elif run:
                run.kept.keep(topic.name, sent, message)
                if topic.name == COMMAND and len(message.data) == len(COMMAND_LABELS):
                    run.commands[float(message.data[0])] = message.data
        if run:
            yield run


def _names(reader: Reader, path: Path, namespace: str | None) -> dict:
    """The topics that are read, by their full names in the bag."""
    types = {connection.topic: connection.msgtype for connection in reader.connections}
    suffix = f"/{COMMAND}"
    found = sorted(name.removesuffix(suffix) for name in types if name.endswith(suffix))
    if namespace is not None:
        found = [name for name in found if name.strip("/") == namespace.strip("/")]
    if len(found) != 1:
        vehicles = ", ".join(name or "/" for name in found) or "none"
        allowed = "the namespace of a vehicle in the bag" if found or namespace else A_BAG
        raise InputError("--namespace", namespace, allowed, f"{path}: vehicles found: {vehicles}")
    names = {f"{found[0]}/{topic.name}": topic for topic in READ}
    for name, topic in names.items():
        if name in types and types[name] != topic.type:
            raise InputError(f"{path}: {name}", types[name], topic.type)
    return names
