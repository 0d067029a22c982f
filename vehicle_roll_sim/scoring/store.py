"""The folder of a score: the commands of every run, so that an interrupted score goes on."""

import hashlib
import json
import zipfile
from pathlib import Path

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import check_folder, replaced_file
from vehicle_roll_sim.scoring.driven import Driven

IDENTITY = "score.json"
"""The file that says what is scored."""
RUNS = "runs"
DAMAGED = (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile)


class Store:
    """The runs with controllers in a folder.

    folder: new, empty, or that of the same score. identity: what its results depend on, by name,
    as JSON has it. Raises InputError naming `field` for the folder of anything else.
    """

    def __init__(self, folder: Path, identity: dict, field: str):
        self.folder, self._runs = folder, folder / RUNS
        check_folder(folder, field)
        text = json.dumps(identity, indent=1, sort_keys=True) + "\n"
        there = folder / IDENTITY
        if there.exists():
            if there.read_text(encoding="utf-8") != text:
                problem = f"{folder} has another score"
                raise InputError(field, str(folder), "a new folder", problem)
        elif folder.exists() and any(folder.iterdir()):
            raise InputError(field, str(folder), "a new or empty folder, or that of a score")
        self._runs.mkdir(parents=True, exist_ok=True)
        with replaced_file(there) as partial:
            partial.write_text(text, encoding="utf-8")

    def load(self, controller: str, run: str) -> Driven | None:
        """A run that has been driven, None if it has not, or if its file is damaged."""
        try:
            return Driven.from_bytes(self._file(controller, run).read_bytes())
        except DAMAGED:
            return None

    def save(self, controller: str, run: str, driven: Driven) -> None:
        """Keep a run; its file appears complete or not at all."""
        with replaced_file(self._file(controller, run)) as partial:
            partial.write_bytes(driven.to_bytes())

    def forget(self, controller: str, run: str) -> None:
        """Remove a run."""
        self._file(controller, run).unlink(missing_ok=True)

    def _file(self, controller: str, run: str) -> Path:
        return self._runs / f"{controller}-{run}.npz"


def fingerprint(content: bytes) -> str:
    """A name for content, in which any change shows."""
    return hashlib.sha256(content).hexdigest()[:16]
