"""Atomic writing of results: a file or set of files appears complete or not at all."""

import contextlib
import errno
import os
import shutil
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path

from vehicle_roll_sim.input_errors import InputError, NotWrittenError

FIGURE_FORMATS = (".png", ".svg", ".pdf")
PAGE_FORMATS = (".html", ".htm")


def check_writable(path: Path, field: str) -> None:
    """Raise InputError naming `field` if no file can be created at `path`."""
    try:
        _check_target(path, field)
        with _partial_file(_resolved(path)):
            pass
    except OSError as error:
        wanted = "a file in a writable folder"
        raise InputError(field, str(path), wanted, f"{path}: {error.strerror}") from None


def _check_target(path: Path, field: str) -> None:
    folder = _resolved(path).parent
    if _exists(path) and not path.is_file():
        raise InputError(field, str(path), "a regular file, not a folder, pipe or device")
    if _exists(path) and not os.access(path, os.W_OK):
        raise InputError(field, str(path), "a writable file")
    if not folder.is_dir():
        raise InputError(field, str(path), f"a file in an existing folder; {folder} does not exist")
    if not os.access(folder, os.W_OK):
        raise InputError(field, str(path), f"a file in a writable folder; {folder} is not writable")


def check_figure_format(path: Path, field: str) -> None:
    """Raise InputError naming `field` if the suffix of `path` is not a supported figure format."""
    if path.suffix.lower() not in FIGURE_FORMATS:
        raise InputError(field, str(path), "a file name ending in " + ", ".join(FIGURE_FORMATS))


def check_page_format(path: Path, field: str) -> None:
    """Raise InputError naming `field` if the suffix of `path` is not that of an HTML page."""
    if path.suffix.lower() not in PAGE_FORMATS:
        raise InputError(field, str(path), "a file name ending in " + ", ".join(PAGE_FORMATS))


@contextlib.contextmanager
def replaced_file(path: str | Path) -> Iterator[Path]:
    """Yield a temporary path, in the same folder and with the same suffix; moved to `path` at exit.

    Raises NotWrittenError if the operating system refuses.
    """
    try:
        path = _resolved(Path(path))  # a link is kept, its target is replaced
        with _partial_file(path) as partial:
            yield partial
            mask = os.umask(0)
            os.umask(mask)
            partial.chmod(0o666 & ~mask)
            partial.replace(path)
    except OSError as error:
        wanted = "a writable location"
        raise NotWrittenError(f"file {path}", "", wanted, error.strerror) from None


@contextlib.contextmanager
def _partial_file(path: Path) -> Iterator[Path]:
    """Yield a new hidden file in the folder of `path`; removed at exit unless it was moved."""
    partial = _hidden(path.parent, path.suffix)
    try:  # begins before the file exists: an interruption may come at any moment
        partial.touch(mode=0o600, exist_ok=False)
        yield partial
    finally:
        _despite_a_signal(lambda: partial.unlink(missing_ok=True))


@contextlib.contextmanager
def _partial_folder(path: Path) -> Iterator[Path]:
    """Yield a new hidden folder beside `path`; removed at exit with everything left in it."""
    partial = _hidden(_existing(path))
    try:
        partial.mkdir(mode=0o700)
        yield partial
    finally:
        _despite_a_signal(lambda: shutil.rmtree(partial) if partial.exists() else None)


def _despite_a_signal(remove: Callable[[], None]) -> None:
    """Remove something, even if a signal raises an exception while it is being removed."""
    try:
        remove()
    except BaseException:
        remove()
        raise


def _hidden(folder: Path, suffix: str = "") -> Path:
    """A unique hidden path."""
    return folder / f".partial-{uuid.uuid4().hex}{suffix}"


def check_folder(path: Path, field: str) -> None:
    """Raise InputError naming `field` if no folder of results can be created or used at `path`."""
    with _refusing_folder(path, field), _partial_folder(path):
        pass


@contextlib.contextmanager
def _refusing_folder(path: Path, field: str) -> Iterator[None]:
    """Convert an OSError in the context to an InputError naming `field`."""
    try:
        yield
    except OSError as error:
        wanted = "a folder that is writable or can be created"
        raise InputError(field, str(path), wanted, f"{path}: {error.strerror}") from None


def check_distinct(paths: dict[str, Path | None]) -> None:
    """Raise InputError if two of these results, by option, have the same path."""
    seen = {}
    for field, path in paths.items():
        if path is None:
            continue
        other = seen.setdefault(_resolved(path), field)
        if other != field:
            raise InputError(field, str(path), f"a path different from that of {other}")


def check_new_folder(path: Path, field: str) -> None:
    """Raise InputError naming `field` if no new folder can be created at `path`."""
    with _refusing_folder(path, field):
        is_there = path.is_symlink() or _exists(_resolved(path))
    if is_there:
        raise InputError(field, str(path), "a folder that does not exist yet")
    check_folder(path, field)


@contextlib.contextmanager
def new_folder(path: Path, field: str) -> Iterator[Path]:
    """Yield a temporary path at which to create a folder; it is moved to `path` at exit.

    Raises InputError naming `field` if `path` exists, NotWrittenError if the operating system
    refuses.
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
            field, str(path), "a writable location", f"{path}: {error.strerror}"
        ) from None


@contextlib.contextmanager
def filled_folder(path: Path) -> Iterator[Path]:
    """Yield a temporary folder to write files to; they are moved to the folder `path` at exit.

    `path` is created if necessary. Files of the same names are replaced, others are kept. Raises
    NotWrittenError if the operating system refuses.
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
        raise NotWrittenError(f"folder {path}", "", "a writable location", error.strerror) from None


def _existing(path: Path) -> Path:
    """The path itself, or its nearest parent that exists."""
    path = _resolved(path)
    while not _exists(path):
        path = path.parent
    return path


def _exists(path: Path) -> bool:
    """Whether the path exists; raises OSError for an impossible name.

    Unlike this function, `Path.exists` of Python 3.14 and later hides that error.
    """
    try:
        path.stat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    return True


def _resolved(path: Path) -> Path:
    """Resolve a path; raises OSError, also for circular links."""
    with contextlib.suppress(RuntimeError):  # circular links, up to Python 3.12
        resolved = path.resolve()
        if not any(each.is_symlink() for each in (resolved, *resolved.parents)):
            return resolved
    raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
