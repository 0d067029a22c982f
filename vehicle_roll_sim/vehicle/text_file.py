"""Reading a user's text file: every way in which that can fail gives one line."""

from pathlib import Path

from vehicle_roll_sim.declaration import InputError

LARGEST_FILE = 1_000_000
"""Bytes. A vehicle or tire file has a few thousand."""


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
        raise InputError(f"file {path}", b"", "a UTF-8 text file", "binary data") from None
    except OSError as error:
        raise InputError(f"file {path}", "", "a readable file", error.strerror) from None
    except InputError:
        raise
    except ValueError as error:  # a name that no file can have
        raise InputError(f"file {str(path)!r}", "", "a readable file", str(error)) from None
