"""Reading a bag whose recorder was killed: its file has chunks, but no index of them.

The library rosbags reads such a file only if its messages lie in the order of their times, which
those of several topics do not quite.
"""

import struct
from collections.abc import Iterator

from rosbags.rosbag2 import Reader
from rosbags.rosbag2.reader import DirectoryReader
from rosbags.rosbag2.storage_mcap import ChunkInfo, McapReader

RECORD = struct.Struct("<cQ")
"""Beginning of a record of MCAP: its kind, and its size from there on."""
CHUNK = b"\x06"
CHUNK_HEAD = struct.Struct("<QQQII")
"""Times of the first and the last message (ns), size, checksum, length of the next name."""
SIZE = struct.Struct("<Q")


class _IndexingReader(McapReader):
    """Makes the index that is missing, so that messages come in the order of their times."""

    def meta_scan(self) -> None:
        super().meta_scan()
        if not self.chunks:
            self.chunks.extend(self._found_chunks())

    def _found_chunks(self) -> Iterator[ChunkInfo]:
        """What an index would say of every chunk, but for which topics it has: maybe all."""
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
    """The library's reader, for bags that were not closed, too."""

    STORAGE_PLUGINS = Reader.STORAGE_PLUGINS | {"dir": _FolderReader}
