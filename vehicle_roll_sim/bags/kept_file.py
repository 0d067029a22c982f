"""An MCAP file that is whole after every chunk, so that a recorder may be killed.

The library rosbags ends a file when it is closed; without its end no reader takes it.
"""

import io
import os
from pathlib import Path

from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.rosbag2.storage_mcap import McapWriter

LARGEST_CHUNK = 4 * 2**20
"""Bytes; the library closes a chunk at 1 MiB and a message."""
END = (
    b"\x0f" + (4).to_bytes(8, "little") + bytes(4)  # end of data, its checksum not given
    + b"\x02" + (20).to_bytes(8, "little") + bytes(20)  # a footer: no summary, no checksum
    + b"\x89MCAP0\r\n"
)  # fmt: skip
"""The shortest end of an MCAP file."""


class KeptFile(McapWriter):
    """Every chunk goes to the file in one piece with an end, which the next one overwrites.

    It is named as rosbag2 names the first file of a bag, and as its reindexer wants it.
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
        """End the file here, for now."""
        place = self.bio.tell()
        self.bio.write(END)
        self.bio.flush()
        self.bio.seek(place)

    def _end_at(self, place: int) -> None:
        """Take back what was only half written, and write no more."""
        file = self.bio.fileno()
        os.ftruncate(file, place)
        os.pwrite(file, END, place)
        os.dup2(os.open(os.devnull, os.O_WRONLY), file)


class _MetadataAlone:
    """In the place of a storage, so that its writer writes the metadata and does not end it."""

    def __init__(self, path: Path):
        self.path = path

    def close(self, *_) -> None:
        pass


class KeptWriter(Writer):
    """A writer whose bag can be read from after every `keep`, whatever becomes of the process."""

    STORAGE_PLUGINS = Writer.STORAGE_PLUGINS | {StoragePlugin.MCAP: KeptFile}

    def begin(self) -> None:
        """Write metadata that has all connections, and no messages yet: it takes 0.1 s."""
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
        """Bring the file up to date with what was written."""
        if self.storage.chunk.msgs:
            self.storage.close_chunk()
