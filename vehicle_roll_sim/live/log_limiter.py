"""Rate limit for repeated log messages."""

import time
from collections.abc import Callable, Hashable


class LogLimiter:
    """Lets each kind of message pass once per interval (s). clock: monotonic, returns s."""

    def __init__(self, interval: float, clock: Callable[[], float] = time.monotonic):
        self._interval, self._clock = interval, clock
        self._said: dict[Hashable, float] = {}

    def allows(self, kind: Hashable) -> bool:
        """Whether a message of that kind may be logged now; if so, it is counted as logged."""
        now = self._clock()
        if kind in self._said and now - self._said[kind] < self._interval:
            return False
        self._said[kind] = now
        return True
