"""Reading a user's text file; any failure is reported as a one-line InputError."""

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


def read_text(path: Path, largest: int = LARGEST_FILE) -> str:
    """The text of a UTF-8 file of at most `largest` bytes; raises InputError naming the file."""
    try:
        size = path.stat().st_size
        if size > largest:
            problem = f"it has {size} bytes"
            raise InputError(f"file {path}", size, f"at most {largest} bytes", problem)
        with path.open(encoding="utf-8-sig") as file:
            text = file.read(largest + 1)
        if len(text) > largest:  # not a regular file: its size was reported as 0
            raise InputError(f"file {path}", "", f"at most {largest} bytes", "it is too long")
        return text
    except UnicodeDecodeError:
        problem = "binary data, or text in another encoding"
        raise InputError(f"file {path}", b"", "a text file in UTF-8", problem) from None
    except OSError as error:
        wanted = WANTED.get(type(error), "give a file that can be read")
        raise InputError(f"file {path}", "", wanted, error.strerror) from None
    except InputError:
        raise
    except ValueError as error:  # an impossible file name
        raise InputError(f"file {str(path)!r}", "", WANTED[FileNotFoundError], str(error)) from None
