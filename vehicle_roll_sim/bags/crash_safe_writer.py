"""An MCAP file that is valid after every chunk, in case the recorder is killed.

The library rosbags writes the end of a file when it is closed; no reader accepts a file without it.
"""

import io
import os
from pathlib import Path

from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.rosbag2.storage_mcap import McapWriter

LARGEST_CHUNK = 4 * 2**20
"""Bytes; the library closes a chunk with the message that exceeds 1 MiB."""
END = (
    b"\x0f" + (4).to_bytes(8, "little") + bytes(4)  # end of data, no checksum
    + b"\x02" + (20).to_bytes(8, "little") + bytes(20)  # a footer: no summary, no checksum
    + b"\x89MCAP0\r\n"
)  # fmt: skip
"""The shortest valid end of an MCAP file."""


class CrashSafeFile(McapWriter):
    """Writes each chunk together with a file end, which the next chunk overwrites.

    The file has the name that rosbag2 gives to the first file of a bag, which its reindexer needs.
    """

    def __init__(self, path: Path, compression):
        super().__init__(path, compression)
        self.path = self.path.rename(path / f"{path.name}_0{self.path.suffix}")
        self.bio = io.BufferedWriter(self.bio.detach(), LARGEST_CHUNK)

    def close_chunk(self) -> None:
        start = self.bio.tell()
        super().close_chunk()
        try:
            self.write_end()
        except OSError:  # a full disk
            self._end_at(start)
            raise

    def write_end(self) -> None:
        """Write a file end here; the next chunk overwrites it."""
        place = self.bio.tell()
        self.bio.write(END)
        self.bio.flush()
        self.bio.seek(place)

    def _end_at(self, place: int) -> None:
        """Truncate a partly written chunk, end the file there, and discard all further writes."""
        file = self.bio.fileno()
        os.ftruncate(file, place)
        os.pwrite(file, END, place)
        os.dup2(os.open(os.devnull, os.O_WRONLY), file)


class _MetadataAlone:
    """Stands in for a storage, so that its writer writes the metadata without closing the file."""

    def __init__(self, path: Path):
        self.path = path

    def close(self, *_) -> None:
        pass


class CrashSafeWriter(Writer):
    """A writer whose bag is readable after every `keep`, even if the process is then killed."""

    STORAGE_PLUGINS = Writer.STORAGE_PLUGINS | {StoragePlugin.MCAP: CrashSafeFile}

    def begin(self) -> None:
        """Write metadata with all connections but no messages; this takes 0.1 s."""
        self.storage.write_end()
        storage, times = self.storage, (self.min_timestamp, self.max_timestamp)
        self.storage = _MetadataAlone(storage.path)
        self.min_timestamp = self.max_timestamp = 0
        try:
            self.close()
        finally:
            self.storage = storage
            self.min_timestamp, self.max_timestamp = times

    def keep(self) -> None:
        """Flush everything written so far to the file."""
        if self.storage.chunk.msgs:
            self.storage.close_chunk()
