"""The folder of a study: its definition, and the completed runs, in chunks.

The file of a chunk is complete or absent, so a study that was stopped at any moment resumes after
its last chunk.
"""

import contextlib
import fcntl
import json
import os
from collections.abc import Iterator
from pathlib import Path

from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.files.text_file import read_text
from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.studies.study import Study

IDENTITY, CHUNKS, LOCK = "study.json", "chunks", ".lock"
PARTIAL = ".partial-*"
TEXTS, CODE = ("version", "vehicle"), "code"
"""What the definition of a study has besides its values; the user's own code only if there is any.
"""
LARGEST = 100_000_000
"""Bytes of a file of the folder."""
ELSEWHERE = "another folder, or the unchanged study: results of different studies are not mixed"


class Store:
    """The folder of a study."""

    def __init__(self, folder: Path):
        self.folder = folder

    @contextlib.contextmanager
    def opened(self, study: Study, field: str) -> Iterator[None]:
        """Create the folder, or resume the study in it; other processes are locked out meanwhile.

        field: names the folder in messages. Raises InputError for the folder of another study.
        """
        with contextlib.ExitStack() as stack:
            with _refused(self.folder, field):
                if not (self.folder / IDENTITY).exists():
                    self._check_new(field)
                self._chunks.mkdir(parents=True, exist_ok=True)
                lock = stack.enter_context((self.folder / LOCK).open("w"))
                try:
                    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    problem = f"{self.folder}: another process runs this study"
                    raise InputError(field, "", "one process at a time", problem) from None
                self._check(study, field)
                for path in (*self.folder.glob(PARTIAL), *self._chunks.glob(PARTIAL)):
                    path.unlink()  # of a process that was killed
            yield

    def _check_new(self, field: str) -> None:
        """Raise InputError for a folder of something else; a study may have just begun in it."""
        if self.folder.exists():
            names = [path.name for path in self.folder.iterdir() if not path.match(PARTIAL)]
            if {*names} - {LOCK, CHUNKS}:
                raise InputError(field, str(self.folder), "a new folder, or that of the same study")

    @property
    def _chunks(self) -> Path:
        return self.folder / CHUNKS

    def _check(self, study: Study, field: str) -> None:
        path = self.folder / IDENTITY
        if not path.exists():
            self._write(path, study.identity)
            return
        before, now = self.identity(field), study.identity
        for key in TEXTS:
            if before.get(key) != now[key]:
                what = "version of the program" if key == "version" else "vehicle"
                problem = f"{self.folder} has the results of another {what}"
                raise InputError(field, "", ELSEWHERE, problem)
        old, new = before.get("study", {}), now["study"]
        for key in {**old, **new}:
            if json.dumps(old.get(key)) != json.dumps(new.get(key)):
                problem = f"{self.folder} has the results of a study with another value of {key}"
                raise InputError(field, "", ELSEWHERE, problem)
        if section := other_code(before, now):
            problem = f"{self.folder} has the results of another {section}: its code or values"
            raise InputError(field, "", ELSEWHERE, problem)

    def identity(self, field: str) -> dict:
        """The study whose folder it is, as Study.identity; raises InputError."""
        path = self.folder / IDENTITY
        if not path.exists():
            raise InputError(field, str(self.folder), "the folder of a study, with a study.json")
        return self._read(path)

    def chunk(self, number: int) -> list[list] | None:
        """The rows of a chunk, each a list of values; None if it is not done."""
        path = self.path(number)
        return self._read(path)["rows"] if path.exists() else None

    def keep(self, number: int, rows: list[list]) -> None:
        """Write the rows of a chunk, so that they survive even a loss of power."""
        self._write(self.path(number), {"rows": rows})

    def path(self, number: int) -> Path:
        """The file of a chunk."""
        return self._chunks / f"{number:06d}.json"

    def _read(self, path: Path) -> dict:
        try:
            content = json.loads(read_text(path, LARGEST))
            if not isinstance(content, dict) or not ("rows" in content or _is_identity(content)):
                raise ValueError
        except (ValueError, RecursionError) as error:
            if isinstance(error, InputError):
                raise
            other = "if you delete it, its runs are computed again"
            if path.name == IDENTITY:
                other = "otherwise begin the study in another folder"
            allowed = f"the file as it was written; {other}"
            raise InputError(f"file {path}", "", allowed, "it was changed") from None
        return content

    def _write(self, path: Path, content: dict) -> None:
        text = json.dumps(content, indent=None if "rows" in content else 1) + "\n"
        with replaced_file(path) as partial, partial.open("w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


def other_code(before: dict, now: dict) -> str:
    """Which of the user's own code differs in two definitions of the same study: "" for none."""
    old, new = before.get(CODE, {}), now.get(CODE, {})
    sections = {**old, **new}
    return next((n for n in sections if json.dumps(old.get(n)) != json.dumps(new.get(n))), "")


def _is_identity(content: dict) -> bool:
    study, code = content.get("study"), content.get(CODE, {})
    are_mappings = isinstance(study, dict) and isinstance(code, dict)
    return are_mappings and all(isinstance(content.get(n), str) for n in TEXTS)


@contextlib.contextmanager
def _refused(folder: Path, field: str) -> Iterator[None]:
    """Convert an OSError in the context to an InputError naming `field`."""
    try:
        yield
    except OSError as error:
        wanted = "a folder that is writable or can be created"
        raise InputError(field, str(folder), wanted, f"{folder}: {error.strerror}") from None
