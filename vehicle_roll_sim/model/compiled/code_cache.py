"""Compiled code on disk: a folder that is sound, or a program that compiles in memory and says so.

numba's own cache trusts what it reads: a truncated file raises whatever pickle makes of it, a
changed byte may be loaded as machine code, and a full disk ends the program. Here every file
carries a digest, and trouble with the folder costs time, never a run.
"""

import hashlib
import os
import pickle
import sys
import tempfile
from pathlib import Path

import numba
from numba.core.caching import FunctionCache, IndexDataCacheFile

COMPLETE = "complete"
"""A file that is there once everything has been compiled."""
ROOM = 30_000_000
"""Bytes: some four times what the compiled code takes."""
DIGEST = hashlib.sha256
WRONG_CODE = (OSError, ValueError, RuntimeError, pickle.PickleError)
"""What writing may raise: the system's refusals, and those of numba and pickle."""


def source_fingerprint(folder: Path) -> str:
    """Hash of every source file of the model, of where they lie and of the version of numba.

    numba renews its cache when the file of a function changes, but not when a function that it
    calls, in another file, does; a folder named after all of the sources does both.
    """
    digest = hashlib.sha256(f"{numba.__version__} {folder}".encode())
    for source in sorted(folder.rglob("*.py")):
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def writable_folder(fingerprint: str) -> Path | None:
    """The folder for compiled code, made if need be; None where none can be written to.

    Until everything is compiled it must also have room for it.
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
        what = "the model is compiled at every start, which takes up to 30 s"
        say(f"{folder} cannot keep compiled code ({error.strerror}): {what}")
        return None


_said: set[str] = set()


def say(what: str) -> None:
    """Tell the user, once in a process."""
    if what not in _said:
        _said.add(what)
        print(what, file=sys.stderr, flush=True)


def troubled() -> bool:
    """Whether anything has gone wrong with the cache in this process."""
    return bool(_said)


class _CheckedFile(IndexDataCacheFile):
    """An index and its data, each file with a digest in front; nothing raises."""

    def load(self, key):
        """The entry of a key, None where there is none that is whole."""
        name = self._load_index().get(key)
        return None if name is None else self._read(self._data_path(name))

    def save(self, key, data):
        try:
            super().save(key, data)
        except WRONG_CODE as error:
            reason = getattr(error, "strerror", None) or error
            say(f"compiled code cannot be kept in {self._cache_path}: {reason}")

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
        """What a file holds; None where it is missing, cannot be read or is damaged."""
        try:
            whole = Path(path).read_bytes()
        except FileNotFoundError:
            return None
        except OSError as error:
            say(f"compiled code cannot be read and is made anew: {error}")
            return None
        size = DIGEST().digest_size
        if _digest(path, whole[size:]) != whole[:size]:
            say(f"compiled code in {self._cache_path} is damaged and made anew")
            return None
        return pickle.loads(whole[size:])


def _digest(path: str, data: bytes) -> bytes:
    """Of the name and what is under it: two files that changed places are damaged, too."""
    return DIGEST(os.path.basename(path).encode() + data).digest()


class CheckedCache(FunctionCache):
    """numba's cache of one function, on files that are checked."""

    def __init__(self, function):
        super().__init__(function)
        plain = self._cache_file
        base = plain._index_name.removesuffix(".nbi")
        self._cache_file = _CheckedFile(self._cache_path, base, plain._source_stamp)

    def save_overload(self, signature, data):
        try:
            super().save_overload(signature, data)
        except OSError as error:  # the folder itself was removed, or is full
            say(f"compiled code cannot be kept in {self._cache_path}: {error.strerror}")
