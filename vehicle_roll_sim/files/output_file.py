"""Writing results: a file or set of files appears when it is whole, or not at all."""

import contextlib
import errno
import os
import shutil
import uuid
from collections.abc import Iterator
from pathlib import Path

from vehicle_roll_sim.declaration import InputError, NotWrittenError

FIGURE_FORMATS = (".png", ".svg", ".pdf")


def check_writable(path: Path, field: str) -> None:
    """Raise InputError naming `field` if no file can be made at `path`."""
    try:
        _check_target(path, field)
        with _partial_file(_resolved(path)):
            pass
    except OSError as error:
        wanted = "a file in a folder that can be written"
        raise InputError(field, str(path), wanted, f"{path}: {error.strerror}") from None


def _check_target(path: Path, field: str) -> None:
    folder = _resolved(path).parent
    if _exists(path) and not path.is_file():
        raise InputError(field, str(path), "an ordinary file, no folder, pipe or device")
    if _exists(path) and not os.access(path, os.W_OK):
        raise InputError(field, str(path), "a file that may be written")
    if not folder.is_dir():
        raise InputError(field, str(path), f"a file in a folder that exists, {folder} does not")
    if not os.access(folder, os.W_OK):
        raise InputError(field, str(path), f"a file in a folder that can be written, not {folder}")


def check_figure_format(path: Path, field: str) -> None:
    """Raise InputError naming `field` if figures are not drawn in the format of `path`."""
    if path.suffix.lower() not in FIGURE_FORMATS:
        raise InputError(field, str(path), "a name that ends in " + ", ".join(FIGURE_FORMATS))


@contextlib.contextmanager
def replaced_file(path: str | Path) -> Iterator[Path]:
    """A path to write to, in the folder of `path` and with its suffix, moved there at the end.

    Raises NotWrittenError if the system does not let it be written.
    """
    try:
        path = _resolved(Path(path))  # a link stays, what it leads to is replaced
        with _partial_file(path) as partial:
            yield partial
            mask = os.umask(0)
            os.umask(mask)
            partial.chmod(0o666 & ~mask)
            partial.replace(path)
    except OSError as error:
        wanted = "a place that can be written to"
        raise NotWrittenError(f"file {path}", "", wanted, error.strerror) from None


@contextlib.contextmanager
def _partial_file(path: Path) -> Iterator[Path]:
    """A new, hidden file in the folder of `path`, gone in the end unless it was moved away."""
    partial = _hidden(path.parent, path.suffix)
    try:  # from before it is made: an interruption may come at any moment
        partial.touch(mode=0o600, exist_ok=False)
        yield partial
    finally:
        partial.unlink(missing_ok=True)


@contextlib.contextmanager
def _partial_folder(path: Path) -> Iterator[Path]:
    """A new, hidden folder where `path` is to be, gone in the end with all that is still in it."""
    partial = _hidden(_existing(path))
    try:
        partial.mkdir(mode=0o700)
        yield partial
    finally:
        if partial.exists():
            shutil.rmtree(partial)


def _hidden(folder: Path, suffix: str = "") -> Path:
    """A path that nothing else has."""
    return folder / f".partial-{uuid.uuid4().hex}{suffix}"


def check_folder(path: Path, field: str) -> None:
    """Raise InputError naming `field` if there can be no folder of results at `path`."""
    with _refusing_folder(path, field), _partial_folder(path):
        pass


@contextlib.contextmanager
def _refusing_folder(path: Path, field: str) -> Iterator[None]:
    """Within, an OSError is an InputError that names `field`."""
    try:
        yield
    except OSError as error:
        wanted = "a folder that can be written to, or made"
        raise InputError(field, str(path), wanted, f"{path}: {error.strerror}") from None


def check_distinct(paths: dict[str, Path | None]) -> None:
    """Raise InputError if two of these results, by the options that name them, are one."""
    seen = {}
    for field, path in paths.items():
        if path is None:
            continue
        other = seen.setdefault(_resolved(path), field)
        if other != field:
            raise InputError(field, str(path), f"another place than that of {other}")


def check_new_folder(path: Path, field: str) -> None:
    """Raise InputError naming `field` if no new folder can be made at `path`."""
    with _refusing_folder(path, field):
        is_there = path.is_symlink() or _exists(_resolved(path))
    if is_there:
        raise InputError(field, str(path), "a folder that does not exist yet")
    check_folder(path, field)


@contextlib.contextmanager
def new_folder(path: Path, field: str) -> Iterator[Path]:
    """Where to make a folder, under the name of `path`; in the end it is moved to `path`, whole.

    Raises InputError naming `field` if there is something already, NotWrittenError if the system
    does not let it.
    """
    check_new_folder(path, field)
    try:
        path = _resolved(path)
        with _partial_folder(path) as beside:
            yield beside / path.name
            path.parent.mkdir(parents=True, exist_ok=True)
            (beside / path.name).rename(path)
    except OSError as error:
        raise NotWrittenError(
            field, str(path), "a place to write to", f"{path}: {error.strerror}"
        ) from None


@contextlib.contextmanager
def filled_folder(path: Path) -> Iterator[Path]:
    """A new folder to write files to; in the end they move to the folder `path`.

    It is made if need be; what it holds already stays, but for files of the same names. Raises
    NotWrittenError if the system does not let it be filled.
    """
    try:
        path = _resolved(path)
        with _partial_folder(path) as partial:
            yield partial
            path.mkdir(parents=True, exist_ok=True)
            files = sorted(partial.iterdir())
            for file in files:
                if (path / file.name).is_dir():
                    raise InputError(f"file {path / file.name}", "", "no folder of that name")
            for file in files:
                file.replace(path / file.name)
    except OSError as error:
        raise NotWrittenError(f"folder {path}", "", "a place to write to", error.strerror) from None


def _existing(path: Path) -> Path:
    """The folder itself, or the nearest above it that exists."""
    path = _resolved(path)
    while not _exists(path):
        path = path.parent
    return path


def _exists(path: Path) -> bool:
    """Whether there is something; raises OSError for a name that nothing can have.

    From Python 3.14 on `Path.exists` does not tell of that.
    """
    try:
        path.stat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    return True


def _resolved(path: Path) -> Path:
    """Where a path leads; raises OSError also for links that lead in a circle."""
    with contextlib.suppress(RuntimeError):  # of a circle, up to Python 3.12
        resolved = path.resolve()
        if not any(each.is_symlink() for each in (resolved, *resolved.parents)):
            return resolved
    raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
