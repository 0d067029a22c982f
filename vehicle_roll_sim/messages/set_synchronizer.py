"""Joins arriving messages of several topics into the sets to which they belong."""

import collections
import itertools
import math
from collections.abc import Iterable

from vehicle_roll_sim.messages.topics import STATE_SET

KEPT = 10
"""Queue length: messages per topic that wait for the rest of their set."""


class SetSynchronizer:
    """Collects one message of each of the topics `names` per set, in whatever order they arrive.

    A simulator sends a set in the order of STATE_SET, so a message sent between two messages of the
    first of these topics belongs to the earlier one. A message from another node (an answer to the
    set) may carry the time of another clock: it belongs to the set during which it was sent or
    received. An incomplete set is dropped once a later one is complete.
    """

    def __init__(self, names: Iterable[str]):
        self.names = tuple(names)
        self._in_set = [topic.name for topic in STATE_SET if topic.name in self.names]
        self._first = (self._in_set or self.names)[0]
        self._kept = {name: collections.deque(maxlen=KEPT) for name in self.names}
        self._newest = -math.inf

    def add(self, name: str, sent: float, message) -> tuple | None:
        """Add a message sent at `sent` (ns); return the set that it completes, else None.

        A set is a tuple with one message for each of `names`, in that order.
        """
        if name == self._first:
            if sent < self._newest:
                self._forget_from(self._newest)
            self._newest = sent
        elif name not in self._in_set:
            sent = max(sent, self._newest)
        self._kept[name].append((sent, message))
        return self._take_complete()

    def _forget_from(self, sent: float) -> None:
        """Drop messages from before the clock was set back: they would never match a later set."""
        for name, kept in self._kept.items():
            early = [each for each in kept if each[0] < sent]
            self._kept[name] = collections.deque(early, maxlen=KEPT)

    def _take_complete(self) -> tuple | None:
        """Remove and return the first complete set, if any, together with everything older."""
        begins = [sent for sent, _ in self._kept[self._first]]
        for begin, end in itertools.pairwise([*begins, math.inf]):
            found = [self._sent_within(name, begin, end) for name in self.names]
            if None in found:
                continue
            for name, (sent, _) in zip(self.names, found, strict=True):
                while self._kept[name] and self._kept[name][0][0] <= sent:
                    self._kept[name].popleft()
            return tuple(message for _, message in found)
        return None

    def _sent_within(self, name: str, begin: float, end: float) -> tuple | None:
        """When the first message of a topic in `begin` <= time < `end` (ns) was sent, and it."""
        return next((each for each in self._kept[name] if begin <= each[0] < end), None)
