"""Verified cache of compiled code on disk; without a usable one the model is compiled in memory.

numba's own cache trusts its files: a truncated file raises an arbitrary pickle error, a changed
byte may be loaded as machine code, and a full disk ends the program. Here every file carries a
digest, and problems with the folder cost time but never a run.
"""

import hashlib
import os
import pickle
import sys
import tempfile
from pathlib import Path

import numba
from numba.core.caching import FunctionCache, IndexDataCacheFile

from vehicle_roll_sim.model.compiled.whole_program import Part

COMPLETE = "complete"
"""Name of the file that marks the cache as complete."""
ROOM = 30_000_000
"""Bytes of free space required: about four times the size of the compiled code."""
DIGEST = hashlib.sha256
WRONG_CODE = (OSError, ValueError, RuntimeError, pickle.PickleError)
"""Exceptions that saving may raise: from the operating system, numba and pickle."""


def source_fingerprint(folder: Path) -> str:
    """Hash of all source files of the model, their location and the version of numba.

    numba recompiles a function when its own file changes, but not when a function that it calls in
    another file changes; a cache folder named by the hash of all sources covers both.
    """
    digest = hashlib.sha256(f"{numba.__version__} {folder}".encode())
    for source in sorted(folder.rglob("*.py")):
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def writable_folder(fingerprint: str) -> Path | None:
    """The folder for compiled code, created if necessary; None if it is not writable.

    Until the cache is complete it must also have enough free space.
    """
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    chosen = numba.config.CACHE_DIR or os.path.join(home, "vehicle_roll_sim")
    folder = Path(chosen) / fingerprint
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            if not (folder / COMPLETE).exists():
                os.posix_fallocate(file.fileno(), 0, ROOM)
        return folder
    except OSError as error:
        effect = "the model is compiled at every start, which takes about 40 s"
        say(f"{folder} cannot store compiled code ({error.strerror}): {effect}")
        return None


_said: set[str] = set()


def say(text: str) -> None:
    """Print a line to stderr, each text once per process."""
    if text not in _said:
        _said.add(text)
        print(text, file=sys.stderr, flush=True)


def troubled() -> bool:
    """Whether there was any problem with the cache in this process."""
    return bool(_said)


class _CheckedFile(IndexDataCacheFile):
    """An index and its data; each file begins with a digest. Nothing raises."""

    def load(self, key):
        """The entry of a key; None if it is missing or damaged."""
        name = self._load_index().get(key)
        return None if name is None else self._read(self._data_path(name))

    def save(self, key, data):
        try:
            super().save(key, data)
        except WRONG_CODE as error:
            reason = getattr(error, "strerror", None) or error
            say(f"compiled code cannot be stored in {self._cache_path}: {reason}")

    def _load_index(self):
        version, stamp, overloads = self._read(self._index_path) or (None, None, {})
        is_fresh = version == self._version and stamp == self._source_stamp
        return overloads if is_fresh else {}

    def _save_index(self, overloads):
        self._write(self._index_path, (self._version, self._source_stamp, overloads))

    def _save_data(self, name, data):
        self._write(self._data_path(name), data)

    def _write(self, path: str, content) -> None:
        data = self._dump(content)
        with self._open_for_write(path) as file:
            file.write(_digest(path, data) + data)

    def _read(self, path: str):
        """The content of a file; None if it is missing, unreadable or damaged."""
        try:
            whole = Path(path).read_bytes()
        except FileNotFoundError:
            return None
        except OSError as error:
            say(f"compiled code cannot be read and is recompiled: {error}")
            return None
        size = DIGEST().digest_size
        if _digest(path, whole[size:]) != whole[:size]:
            say(f"compiled code in {self._cache_path} is damaged and is recompiled")
            return None
        return pickle.loads(whole[size:])


def _digest(path: str, data: bytes) -> bytes:
    """Digest of file name and content, so that swapped files are detected as well."""
    return DIGEST(os.path.basename(path).encode() + data).digest()


class CheckedCache(FunctionCache):
    """numba's cache of one function, with verified files."""

    def __init__(self, function):
        super().__init__(function)
        plain = self._cache_file
        base = plain._index_name.removesuffix(".nbi")
        self._cache_file = _CheckedFile(self._cache_path, base, plain._source_stamp)

    def load_overload(self, signature, target_context):
        """As in numba, but without loading first all that numba can compile, a third of a start."""
        with self._guard_against_spurious_io_errors():
            return self._load_overload(signature, target_context)

    def save_overload(self, signature, data):
        if isinstance(data.library, Part):
            return
        try:
            super().save_overload(signature, data)
        except OSError as error:  # the folder was removed, or the disk is full
            say(f"compiled code cannot be stored in {self._cache_path}: {error.strerror}")
