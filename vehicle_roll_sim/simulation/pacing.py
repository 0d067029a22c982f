"""Keeping simulated time in step with a steady clock."""

import time
from collections.abc import Callable

LARGEST_CATCH_UP_NS = 100_000_000
"""More than this behind (ns) is given up and counted, so that simulated time never jumps."""
EARLY = 0.5
"""Share of a period by which a wake-up may come before its deadline and still count for it."""


class Pacer:
    """How many periods of `period_ns` are due, by absolute deadlines.

    clock: returns ns and never goes back. late_ns: how late the last call was; largest_late_ns:
    the most since it was last set to 0; overruns: periods given up.
    """

    def __init__(self, period_ns: int, clock: Callable[[], int] = time.monotonic_ns):
        self.period_ns, self.clock = period_ns, clock
        self.overruns = 0
        self.restart()

    def restart(self) -> None:
        """The first period is due one period after the next call of `due`."""
        self.deadline_ns: int | None = None
        self.late_ns = self.largest_late_ns = 0

    def due(self) -> int:
        """Number of periods to run now; they count as run."""
        now = self.clock()
        if self.deadline_ns is None:
            self.deadline_ns = now + self.period_ns
        late = now - self.deadline_ns
        if late < -self.period_ns * EARLY:
            return 0
        self.late_ns = max(late, 0)
        self.largest_late_ns = max(self.largest_late_ns, self.late_ns)
        given_up = max(late - LARGEST_CATCH_UP_NS, 0) // self.period_ns
        self.overruns += given_up
        count = self.late_ns // self.period_ns + 1
        self.deadline_ns += count * self.period_ns
        return count - given_up
