"""Snapshots: the state of a simulation as a value, to restore, branch from or transfer."""

import abc
import base64
import dataclasses
import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Self

import numpy as np

from vehicle_roll_sim.input_errors import InputError, given
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.simulation.snapshot_file import read_snapshot, text_of, write_snapshot

KIND = "simulation"


@dataclasses.dataclass(frozen=True)
class Snapshot:
    """Everything that determines how a simulation continues, at one simulated time (ns).

    `plant` identifies what is simulated: vehicle, tire, options, road, step and rollover angle.
    `memory` holds the bytes of the simulation's arrays. A snapshot never changes, compares by
    value, can be hashed and pickled, and can be restored any number of times.
    """

    plant: str
    time_ns: int
    condition: Condition
    implausible: str | None
    checked_speed: float | None
    memory: tuple[bytes, ...]

    @property
    def time(self) -> float:
        """Simulated time (s)."""
        return self.time_ns / NANOSECONDS

    def as_plain(self) -> dict:
        """The snapshot as numbers and texts, from which `of_plain` makes an equal one."""
        memory = [base64.b64encode(each).decode() for each in self.memory]
        parts = {each.name: getattr(self, each.name) for each in dataclasses.fields(self)}
        return parts | {"condition": self.condition.name, "memory": memory}

    @classmethod
    def of_plain(cls, parts: dict) -> Self:
        """The snapshot of which `as_plain` returned these parts."""
        memory = tuple(base64.b64decode(each) for each in parts["memory"])
        return cls(**parts | {"condition": Condition[parts["condition"]], "memory": memory})

    def write(self, path: str | Path) -> None:
        """Write a file, whole or not at all; raises NotWrittenError if that is impossible."""
        write_snapshot(path, KIND, text_of(self.as_plain()))

    @classmethod
    def of_file(cls, path: str | Path) -> Self:
        """The snapshot in a file; raises InputError if it is damaged or of another version."""
        return cls.of_plain(json.loads(read_snapshot(path, KIND)))

    def write_to(self, arrays: Iterable[np.ndarray], plant: str) -> None:
        """Fill the arrays; raises InputError if the snapshot belongs to another plant."""
        arrays = list(arrays)
        sizes = [array.nbytes for array in arrays]  # another version may have other sizes
        if plant != self.plant or sizes != [len(kept) for kept in self.memory]:
            allowed = "a snapshot with the same vehicle, options, road, step and rollover angle"
            raise InputError("snapshot", "", allowed, "taken from a different simulation")
        for array, kept in zip(arrays, self.memory, strict=True):
            array.view(np.uint8).reshape(-1)[:] = np.frombuffer(kept, np.uint8)


def identity(engine: str, records: Iterable[np.ndarray], step_ns: int) -> str:
    """A digest of the records of a plant, its integration step (ns) and its engine."""
    digest = hashlib.sha256(f"{engine} {step_ns}".encode())
    for each in records:
        digest.update(each.tobytes())
    return digest.hexdigest()


class Restorable(abc.ABC):
    """A simulation that can be copied and pickled: the copy is constructed and then restored.

    Members cannot be copied one by one, because arrays and their views must share memory.
    Attributes added by a subclass or a user are copied in Python's usual way.
    """

    def snapshot(self) -> Snapshot:
        """The present state as a value; after `restore` the simulation continues bit for bit."""
        memory = tuple(each.tobytes() for each in self._memory)
        now = (self.time_ns, self.condition, self.implausible, self._checked_speed)
        return Snapshot(self._identity, *now, memory)

    @classmethod
    def from_snapshot(cls, snapshot: Snapshot, *arguments, **others) -> Self:
        """A simulation constructed with these arguments that continues from a snapshot.

        They are the arguments of the simulation of which it was taken. Raises InputError if they
        are not, or if they are invalid.
        """
        simulation = cls(*arguments, **others)
        simulation.restore(snapshot)
        return simulation

    def restore(self, snapshot: Snapshot) -> None:
        """Restore a snapshot of this simulation or of one constructed with the same arguments.

        Raises InputError, without any change, if it was taken from a different simulation.
        """
        given("snapshot", snapshot, Snapshot)
        snapshot.write_to(self._memory, self._identity)
        self.time_ns, self.condition = snapshot.time_ns, snapshot.condition
        self.implausible, self._checked_speed = snapshot.implausible, snapshot.checked_speed

    def __reduce__(self):
        added = {name: value for name, value in vars(self).items() if name not in self._built}
        return _rebuilt, (type(self), self._arguments()), (added, self.snapshot())

    def __setstate__(self, state: tuple[dict, Snapshot]) -> None:
        added, snapshot = state
        vars(self).update(added)
        self.restore(snapshot)

    @abc.abstractmethod
    def _arguments(self) -> dict:
        """Constructor arguments of a simulation that accepts snapshots of this one."""

    @abc.abstractmethod
    def _build(self, arguments: dict) -> None:
        """Construct the members of this class, but not of subclasses; `_built` has their names."""


def _rebuilt(kind: type[Restorable], arguments: dict) -> Restorable:
    """Construct without calling a user subclass's constructor, which may take other arguments."""
    copy = kind.__new__(kind)
    copy._build(arguments)
    return copy
