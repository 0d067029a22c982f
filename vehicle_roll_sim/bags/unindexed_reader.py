"""Reads a bag whose recorder was killed: its file has chunks, but no chunk index.

The library rosbags reads such a file only if its messages are in order of time, which those of
several topics are not quite.
"""

import struct
from collections.abc import Iterator

from rosbags.rosbag2 import Reader
from rosbags.rosbag2.reader import DirectoryReader
from rosbags.rosbag2.storage_mcap import ChunkInfo, McapReader

RECORD = struct.Struct("<cQ")
"""Header of an MCAP record: its opcode, and the number of bytes that follow."""
CHUNK = b"\x06"
CHUNK_HEAD = struct.Struct("<QQQII")
"""Times of the first and last message (ns), uncompressed size, checksum, length of the string that
names the compression."""
SIZE = struct.Struct("<Q")


class _IndexingReader(McapReader):
    """Rebuilds a missing chunk index, so that messages are read in order of time."""

    def meta_scan(self) -> None:
        super().meta_scan()
        if not self.chunks:
            self.chunks.extend(self._found_chunks())

    def _found_chunks(self) -> Iterator[ChunkInfo]:
        """The index entry of every chunk; its topics are unknown, so all are listed."""
        every_topic = dict.fromkeys(self.channels, 1)
        place = self.data_start
        while place < self.data_end:
            self.bio.seek(place)
            kind, size = RECORD.unpack(self.bio.read(RECORD.size))
            if kind == CHUNK:
                first, last, whole, _, length = CHUNK_HEAD.unpack(self.bio.read(CHUNK_HEAD.size))
                compression = self.bio.read(length).decode()
                (packed,) = SIZE.unpack(self.bio.read(SIZE.size))
                end = RECORD.size + size
                yield ChunkInfo(
                    first, last, place, end, {}, 0, compression, packed, whole, every_topic
                )
            place += RECORD.size + size


class _FolderReader(DirectoryReader):
    STORAGE_PLUGINS = DirectoryReader.STORAGE_PLUGINS | {"mcap": _IndexingReader}


class BagReader(Reader):
    """The library's reader, extended to bags that were not closed."""

    STORAGE_PLUGINS = Reader.STORAGE_PLUGINS | {"dir": _FolderReader}
