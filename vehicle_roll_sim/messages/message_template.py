"""Messages as serialized bytes: encoded once, with their changing numbers overwritten in place.

Filling and serializing a message object field by field costs several times as much as sending it.
"""

import struct
from collections.abc import Callable

import numpy as np

Encode = Callable[[str, dict], bytes]
"""Returns the CDR bytes of a message, given its type ("std_msgs/msg/Float64") and a dictionary of
its fields, with nested messages as nested dictionaries; omitted fields are 0 or empty."""
STAMP = struct.Struct("<iI")
"""Seconds and nanoseconds."""
STAMP_MARK = {"sec": 1_701_408_733, "nanosec": 987_654_321}
"""A placeholder time that no message contains otherwise; it is replaced by the stamp."""
MARK = 0.7390851332151607
"""A placeholder number that no message contains otherwise."""


class MessageTemplate:
    """The bytes of a message, in which numbers and stamps can be set.

    message: the encoded message with placeholders. count: how many numbers can be set from each
    occurrence of `mark` on; they are contiguous, in the order of the definition. kind: their numpy
    dtype. tail: bytes to keep after the last numbers; encoders may append more for empty lists,
    which is cut off. `numbers` is a view of the numbers at the first mark, `groups` has one view
    for each mark.
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
        """Set every stamp in the message."""
        for place in self._stamps:
            STAMP.pack_into(self._bytes, place, seconds, nanoseconds)

    def __bytes__(self) -> bytes:
        return bytes(self._bytes)
