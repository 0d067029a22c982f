"""Messages as the bytes that go out: encoded once, their changing numbers written in place.

Filling and converting a message object field by field costs several times what sending it does.
"""

import struct

import numpy as np
from rclpy.serialization import serialize_message

STAMP_AT = 4
"""Bytes before a header's stamp: those that name the encoding."""
STAMP = struct.Struct("<iI")
"""Seconds and nanoseconds."""
MARK = 0.7390851332151607
"""A number that no field of a message has by itself."""


class Encoded:
    """The bytes of `message`, of which `count` numbers are open as `numbers` (a view).

    They begin where the message has `mark`, and follow one another as they do in its definition.
    kind: what numbers they are.
    """

    def __init__(self, message, count: int = 0, mark=MARK, kind: str = "<f8"):
        self._bytes = bytearray(serialize_message(message))
        first = self._bytes.index(np.array(mark, kind).tobytes()) if count else 0
        self.numbers = np.frombuffer(self._bytes, kind, count, first)

    def stamp(self, seconds: int, nanoseconds: int) -> None:
        """Set the stamp of a message that begins with one, alone or in a header."""
        STAMP.pack_into(self._bytes, STAMP_AT, seconds, nanoseconds)

    def __bytes__(self) -> bytes:
        return bytes(self._bytes)
