"""Saying the same thing now and then only."""

import time
from collections.abc import Callable, Hashable


class LogLimiter:
    """Lets each kind of thing be said once an interval (s). clock: gives s, never goes back."""

    def __init__(self, interval: float, clock: Callable[[], float] = time.monotonic):
        self._interval, self._clock = interval, clock
        self._said: dict[Hashable, float] = {}

    def lets(self, kind: Hashable) -> bool:
        """Whether to say a thing of that kind now; it then counts as said."""
        now = self._clock()
        if kind in self._said and now - self._said[kind] < self._interval:
            return False
        self._said[kind] = now
        return True
