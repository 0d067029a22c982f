"""Snapshots of a session: everything that determines how it continues, as a value."""

import dataclasses
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Self

from vehicle_roll_sim.simulation.command import Command
from vehicle_roll_sim.simulation.memory import WithMemory
from vehicle_roll_sim.simulation.snapshot import Snapshot
from vehicle_roll_sim.simulation.snapshot_file import (
    digest_of,
    read_snapshot,
    text_of,
    write_snapshot,
)

KIND = "session"
DIGITS = 16
"""Hexadecimal digits of a token: two of 10^9 snapshots share it with a probability of 3 %."""


@dataclasses.dataclass(frozen=True)
class SessionSnapshot:
    """A snapshot of a `Session`: it never changes, compares by value, and can be hashed and
    pickled, and restored any number of times.

    text: the settings of the session, the snapshot of its simulation, the command applied last and
    the memory of its parts, as JSON.
    """

    text: str

    @classmethod
    def of(
        cls,
        settings: Mapping,
        simulation: Snapshot,
        applied: Command,
        parts: Mapping[str, WithMemory],
    ) -> Self:
        """Compose a snapshot of those of its parts."""
        content = {
            "settings": settings,
            "simulation": simulation.as_plain(),
            "applied": dataclasses.asdict(applied),
            "parts": {name: part.memory() for name, part in parts.items()},
        }
        return cls(text_of(content))

    @property
    def content(self) -> dict:
        """The parts of the text, a new object each time."""
        return json.loads(self.text)

    @property
    def simulation(self) -> Snapshot:
        """The snapshot of the simulation alone."""
        return Snapshot.of_plain(self.content["simulation"])

    @property
    def token(self) -> str:
        """A short name, the same for equal snapshots: an s and 16 hexadecimal digits."""
        return "s" + digest_of(self.text)[:DIGITS]

    def write(self, path: str | Path) -> None:
        """Write a file, whole or not at all; raises NotWrittenError if that is impossible."""
        write_snapshot(path, KIND, self.text)

    @classmethod
    def of_file(cls, path: str | Path) -> Self:
        """The snapshot in a file; raises InputError if it is damaged or of another version."""
        return cls(read_snapshot(path, KIND))
