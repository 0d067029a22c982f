"""Reading a user's text file: every way in which that can fail gives one line."""

from pathlib import Path

from vehicle_roll_sim.declaration import InputError

LARGEST_FILE = 1_000_000
"""Bytes. A vehicle or tire file has a few thousand."""

WANTED = {
    FileNotFoundError: "the name of a file that exists is wanted",
    NotADirectoryError: "the name of a file that exists is wanted",
    IsADirectoryError: "the name of a file, not of a folder, is wanted",
    PermissionError: "a file that this user may read is wanted",
}
"""What a name should be that cannot be read, by the error."""


def read_text(path: Path, largest: int = LARGEST_FILE) -> str:
    """The text of a UTF-8 file of at most `largest` bytes; raises InputError naming the file."""
    try:
        size = path.stat().st_size
        if size > largest:
            problem = f"{size} bytes are too many"
            raise InputError(f"file {path}", size, f"at most {largest} bytes", problem)
        with path.open(encoding="utf-8-sig") as file:
            text = file.read(largest + 1)
        if len(text) > largest:  # of what has no size beforehand
            raise InputError(f"file {path}", "", f"at most {largest} bytes", "endless")
        return text
    except UnicodeDecodeError:
        problem = "binary data, or text in another encoding"
        raise InputError(f"file {path}", b"", "a text file in UTF-8", problem) from None
    except OSError as error:
        wanted = WANTED.get(type(error), "a file that can be read is wanted")
        raise InputError(f"file {path}", "", wanted, error.strerror) from None
    except InputError:
        raise
    except ValueError as error:  # a name that no file can have
        raise InputError(f"file {str(path)!r}", "", WANTED[FileNotFoundError], str(error)) from None
