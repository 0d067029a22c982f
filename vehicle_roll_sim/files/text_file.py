"""Reading a user's text file; any failure is reported as a one-line InputError."""

import contextlib
from pathlib import Path

from vehicle_roll_sim.declaration import InputError

LARGEST_FILE = 1_000_000
"""Bytes; vehicle and tire files have a few thousand."""

WANTED = {
    FileNotFoundError: "give the name of an existing file",
    NotADirectoryError: "give the name of an existing file",
    IsADirectoryError: "give the name of a file, not of a folder",
    PermissionError: "give a file that this user may read",
}
"""The last part of the error message, by the kind of the error."""


def read_text(
    path: Path, largest: int = LARGEST_FILE, encodings: tuple[str, ...] = ("utf-8-sig",)
) -> str:
    """The text of a file of at most `largest` bytes in the first of the encodings that fits it.

    All line ends become line feeds. Raises InputError naming the file.
    """
    try:
        size = path.stat().st_size
        if size > largest:
            problem = f"it has {size} bytes"
            raise InputError(f"file {path}", size, f"at most {largest} bytes", problem)
        with path.open("rb") as file:
            content = file.read(largest + 1)
        if len(content) > largest:  # not a regular file: its size was reported as 0
            raise InputError(f"file {path}", "", f"at most {largest} bytes", "it is too long")
    except OSError as error:
        wanted = WANTED.get(type(error), "give a file that can be read")
        raise InputError(f"file {path}", "", wanted, error.strerror) from None
    except InputError:
        raise
    except ValueError as error:  # an impossible file name
        raise InputError(f"file {str(path)!r}", "", WANTED[FileNotFoundError], str(error)) from None
    return _decoded(content, path, encodings).replace("\r\n", "\n").replace("\r", "\n")


def _decoded(content: bytes, path: Path, encodings: tuple[str, ...]) -> str:
    for encoding in encodings:
        with contextlib.suppress(UnicodeDecodeError):
            return content.decode(encoding)
    problem = "binary data, or text in another encoding"
    raise InputError(f"file {path}", b"", "a text file in UTF-8", problem)
