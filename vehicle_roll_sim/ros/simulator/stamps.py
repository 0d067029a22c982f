"""Stamps of the sets where time is not the simulation's own: on the node's clock, always rising."""

import math
import time
from collections.abc import Callable

LARGEST_STEP_NS = 1_000_000
"""What the clock may gain or lose (ns) before it counts as having been set."""
CLOSE_NS = 20_000
"""Time (ns) between two readings of a clock; another one read in between was read well enough."""
MOST_READINGS = 20
"""Of which the closest counts: a thread may be interrupted in between."""


class Stamps:
    """Gives each set the time on a clock at which it was due, and never an earlier one.

    Between two anchors stamps are as far apart as simulated time is. now: the clock, which may be
    set; steady: the one that periods are paced by, which may not, but stands still while the host
    is suspended. Both in ns.
    """

    def __init__(self, now: Callable[[], int], steady: Callable[[], int] = time.monotonic_ns):
        self._now, self._steady = now, steady
        self._last_ns = -1
        self.anchor(0, steady())

    def anchor(self, time_ns: int, due_ns: int) -> None:
        """From now on the set of simulated time `time_ns` is due at `due_ns` by the steady clock.

        Where the clock was set back, the stamps go on from the last one.
        """
        stamp_ns = max(self._difference() + due_ns, self._last_ns + 1)
        self._begin_ns, self._difference_ns = stamp_ns - time_ns, stamp_ns - due_ns

    def of(self, time_ns: int) -> int:
        """The stamp of the set of a simulated time; both ns."""
        self._last_ns = self._begin_ns + time_ns
        return self._last_ns

    def lead_ns(self) -> int:
        """How far stamps are ahead of the clock, since it was set; negative: behind it."""
        lead_ns = self._difference_ns - self._difference()
        return lead_ns if abs(lead_ns) > LARGEST_STEP_NS else 0

    def follow(self) -> int:
        """Make up for what the clock has gained by being set, or on a suspended host; how much."""
        gained_ns = max(-self.lead_ns(), 0)
        self._begin_ns += gained_ns
        self._difference_ns += gained_ns
        return gained_ns

    def _difference(self) -> int:
        """The clock less the steady one, which is read before and after it."""
        closest_ns, difference_ns = math.inf, 0
        for _ in range(MOST_READINGS):
            before, now, after = self._steady(), self._now(), self._steady()
            if after - before < closest_ns:
                closest_ns, difference_ns = after - before, now - (before + after) // 2
            if closest_ns < CLOSE_NS:
                break
        return difference_ns
