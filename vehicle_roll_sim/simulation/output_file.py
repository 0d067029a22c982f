"""Writing a result: the file appears under its name when it is whole, or not at all."""

import contextlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

from vehicle_roll_sim.declaration import InputError


def check_writable(path: Path, field: str) -> None:
    """Raise InputError naming `field` if no file can be made at `path`."""
    folder = path.parent
    if path.is_dir():
        raise InputError(field, str(path), "a file, this is a folder")
    if not folder.is_dir():
        raise InputError(field, str(path), f"a file in a folder that exists, {folder} does not")
    if not os.access(folder, os.W_OK):
        raise InputError(field, str(path), f"a file in a folder that can be written, not {folder}")


@contextlib.contextmanager
def replaced_file(path: Path) -> Iterator[Path]:
    """A path to write to, in the folder of `path` and with its suffix, moved there at the end."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem}-", suffix=path.suffix)
    os.close(handle)
    partial = Path(name)
    try:
        yield partial
        mask = os.umask(0)
        os.umask(mask)
        partial.chmod(0o666 & ~mask)
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
