"""The snapshots of a simulator by token: the latest in memory, and all as files if wanted."""

import re
from collections import OrderedDict
from pathlib import Path

from vehicle_roll_sim.files.output_file import check_folder
from vehicle_roll_sim.input_errors import InputError, NotWrittenError
from vehicle_roll_sim.live.session_snapshot import DIGITS, SessionSnapshot

MOST_KEPT = 1000
"""Snapshots in memory, about 16 kB each; then the oldest is forgotten."""
TOKEN = re.compile(rf"s[0-9a-f]{{{DIGITS}}}")
ENDING = ".snapshot"


class SnapshotStore:
    """Keeps snapshots. folder: where each is also written to TOKEN.snapshot; '': nowhere.

    Raises InputError naming `snapshot_folder` if it is no folder and cannot be created.
    """

    def __init__(self, folder: str):
        self._folder = Path(folder) if folder else None
        if self._folder:
            check_folder(self._folder, "snapshot_folder")
        self._kept: OrderedDict[str, SessionSnapshot] = OrderedDict()

    def save(self, snapshot: SessionSnapshot) -> str:
        """Keep a snapshot and return its token; raises NotWrittenError if it cannot be written."""
        token = snapshot.token
        if self._folder:
            self._write(snapshot, self._folder / (token + ENDING))
        self._kept[token] = snapshot
        self._kept.move_to_end(token)
        while len(self._kept) > MOST_KEPT:
            self._kept.popitem(last=False)
        return token

    def _write(self, snapshot: SessionSnapshot, path: Path) -> None:
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            place, wanted = str(path.parent), "a folder that can be created"
            raise NotWrittenError("snapshot_folder", place, wanted, error.strerror) from None
        snapshot.write(path)

    def find(self, token: str) -> SessionSnapshot:
        """The snapshot of a token, or the last one saved for ''; raises InputError without one."""
        if not token:
            if not self._kept:
                raise InputError("snapshot", "", "a token of ~/save", "nothing has been saved yet")
            return next(reversed(self._kept.values()))
        if token in self._kept:
            return self._kept[token]
        if not TOKEN.fullmatch(token):
            raise InputError("snapshot", token, "a token as ~/save returned it")
        path = self._folder / (token + ENDING) if self._folder else None
        if path is None or not path.exists():
            where = f"no file in {self._folder}" if path else "not in memory"
            raise InputError("snapshot", token, "a token of a snapshot that is kept", where)
        snapshot = SessionSnapshot.of_file(path)
        if snapshot.token != token:
            raise InputError(f"file {path}", "", "the name that it was saved under", "renamed")
        return snapshot
