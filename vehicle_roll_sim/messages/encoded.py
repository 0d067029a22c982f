"""Messages as the bytes that go out: encoded once, their changing numbers written in place.

Filling and converting a message object field by field costs several times what sending it does.
"""

import struct
from collections.abc import Callable

import numpy as np

Encode = Callable[[str, dict], bytes]
"""Gives the CDR bytes of a message: its type ("std_msgs/msg/Float64"), and its fields by name, a
message within as a dictionary again; what is not named is 0 or empty."""
STAMP = struct.Struct("<iI")
"""Seconds and nanoseconds."""
STAMP_MARK = {"sec": 1_701_408_733, "nanosec": 987_654_321}
"""A time that no message has by itself: where a message has it, it is stamped."""
MARK = 0.7390851332151607
"""A number that no field of a message has by itself."""


class Encoded:
    """The bytes of a message, in which numbers and stamps can be set.

    count: how many numbers are open behind each place where the message has `mark`; they follow one
    another as they do in its definition. kind: what numbers they are. tail: bytes of the message
    behind its last numbers, if more must be cut off, which encoders reserve for empty lists.
    `numbers` is a view of those behind the first mark, `groups` has one for each mark.
    """

    def __init__(
        self, message: bytes, count: int = 0, mark=MARK, kind: str = "<f8", tail: int | None = None
    ):
        self._bytes = bytearray(message)
        marks = self._places(np.array(mark, kind).tobytes()) if count else []
        if tail is not None:
            del self._bytes[marks[-1] + count * np.dtype(kind).itemsize + tail :]
        self._stamps = self._places(STAMP.pack(*STAMP_MARK.values()))
        self.groups = [np.frombuffer(self._bytes, kind, count, place) for place in marks]
        self.numbers = self.groups[0] if self.groups else None

    def _places(self, mark: bytes) -> list[int]:
        places, place = [], self._bytes.find(mark)
        while place >= 0:
            places.append(place)
            place = self._bytes.find(mark, place + len(mark))
        return places

    def stamp(self, seconds: int, nanoseconds: int) -> None:
        """Set every stamp of the message."""
        for place in self._stamps:
            STAMP.pack_into(self._bytes, place, seconds, nanoseconds)

    def __bytes__(self) -> bytes:
        return bytes(self._bytes)
