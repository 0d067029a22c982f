"""Keeping simulated time in step with a steady clock."""

import time
from collections.abc import Callable

LARGEST_CATCH_UP_NS = 100_000_000
"""More than this behind (ns) is given up and counted, so that simulated time never jumps."""
EARLY = 0.5
"""Share of a period by which a wake-up may come before its deadline and still count for it."""


class Pacer:
    """When the periods of `period_ns` are due, by absolute deadlines.

    clock: returns ns and never goes back. largest_late_ns: the most that a period came late since
    this was last set to 0; overruns: periods given up.
    """

    def __init__(self, period_ns: int, clock: Callable[[], int] = time.monotonic_ns):
        self.period_ns, self.clock = period_ns, clock
        self.overruns = 0
        self.restart()

    def restart(self) -> None:
        """The first period is due one period after the next call of `due`."""
        self.deadline_ns: int | None = None
        self.largest_late_ns = 0

    def due(self) -> bool:
        """Whether to run a period now; it then counts as run."""
        now = self.clock()
        if self.deadline_ns is None:
            self.deadline_ns = now + self.period_ns
        late = now - self.deadline_ns
        if late < -self.period_ns * EARLY:
            return False
        self.largest_late_ns = max(self.largest_late_ns, late)
        given_up = max(late - LARGEST_CATCH_UP_NS, 0) // self.period_ns
        self.overruns += given_up
        self.deadline_ns += (given_up + 1) * self.period_ns
        return True

    @property
    def behind(self) -> bool:
        """Whether the deadline of the next period has passed already."""
        return self.deadline_ns is not None and self.clock() >= self.deadline_ns
