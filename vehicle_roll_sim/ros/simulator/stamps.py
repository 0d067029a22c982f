"""Stamps of sets that do not use simulated time: from the node's clock, never decreasing."""

import math
import time
from collections.abc import Callable

LARGEST_STEP_NS = 1_000_000
"""How much the clock may gain or lose (ns) before it counts as having been set."""
CLOSE_NS = 20_000
"""Two clocks are compared well enough if both are read within this time (ns)."""
MOST_READINGS = 20
"""Attempts, of which the closest counts: a thread may be interrupted between readings."""


class Stamps:
    """Gives each set the clock time at which it was due, never earlier than the one before.

    Between two anchors, stamps are spaced like simulated time. now: the clock, which may be set.
    steady: the clock that paces periods; it cannot be set, but stops while the host is suspended.
    Both return ns.
    """

    def __init__(self, now: Callable[[], int], steady: Callable[[], int] = time.monotonic_ns):
        self._now, self._steady = now, steady
        self._last_ns = -1
        self.anchor(0, steady())

    def anchor(self, time_ns: int, due_ns: int) -> None:
        """From now on, the set of simulated time `time_ns` is due at `due_ns` on the steady clock.

        If the clock was set back, the stamps continue from the last one.
        """
        stamp_ns = max(self._difference() + due_ns, self._last_ns + 1)
        self._begin_ns, self._difference_ns = stamp_ns - time_ns, stamp_ns - due_ns

    def of(self, time_ns: int) -> int:
        """The stamp (ns) of the set of a simulated time (ns)."""
        self._last_ns = self._begin_ns + time_ns
        return self._last_ns

    def lead_ns(self) -> int:
        """How far stamps are ahead (behind if negative) of a clock that was set (ns), else 0."""
        lead_ns = self._difference_ns - self._difference()
        return lead_ns if abs(lead_ns) > LARGEST_STEP_NS else 0

    def follow(self) -> int:
        """Move stamps forward with a clock that was set ahead; return by how much (ns).

        A host that was suspended has the same effect.
        """
        gained_ns = max(-self.lead_ns(), 0)
        self._begin_ns += gained_ns
        self._difference_ns += gained_ns
        return gained_ns

    def _difference(self) -> int:
        """The clock minus the steady one (ns), which is read before and after it."""
        closest_ns, difference_ns = math.inf, 0
        for _ in range(MOST_READINGS):
            before, now, after = self._steady(), self._now(), self._steady()
            if after - before < closest_ns:
                closest_ns, difference_ns = after - before, now - (before + after) // 2
            if closest_ns < CLOSE_NS:
                break
        return difference_ns
