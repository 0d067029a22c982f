"""Pacing of simulated time against a monotonic clock, in real time or scaled."""

import math
import time
from collections import deque
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.model.integration.advance import NANOSECONDS

DEFAULT_CATCH_UP = 0.1
"""s"""
LONGEST_NAP_NS = 100_000_000
"""ns: longest uninterrupted sleep, so that a request to stop is noticed in time."""
LONGEST_BUSY_NS = 5_000_000
"""ns: time without a sleep after which a short sleep lets other threads run."""
REST = 1e-4
"""s: duration of that short sleep."""
KEPT = 10_000
"""Maximum number of periods whose lateness is stored."""
SLOWEST_FACTOR, FASTEST_FACTOR = 0.1, 100.0
AS_FAST_AS_POSSIBLE = 0.0
PERCENTILES = (50, 99, 100)


class Pacer:
    """Schedules periods of `period_ns` (ns of simulated time) by absolute deadlines.

    factor: ratio of simulated to real time; AS_FAST_AS_POSSIBLE: no deadlines. catch_up: largest
    delay (s by the clock) that is made up for; deadlines further back are dropped, so that the
    simulation does not race. `overruns`: number of deadlines dropped. clock: monotonic, returns ns.
    sleep: takes s.
    """

    def __init__(
        self,
        period_ns: int,
        factor: float = 1.0,
        catch_up: float = DEFAULT_CATCH_UP,
        clock: Callable[[], int] = time.monotonic_ns,
        sleep: Callable[[float], None] = time.sleep,
    ):
        self.clock, self.sleep = clock, sleep
        self._period_ns = period_ns / factor if factor else 0.0
        self._catch_up_ns = catch_up * NANOSECONDS
        self.overruns = 0
        self._late_ns: deque[int] = deque(maxlen=KEPT)
        self._rested_ns = clock()
        self.restart()

    def restart(self) -> None:
        """Restart the schedule: the first period is due one period from now."""
        self._next = (self.clock(), 1)
        self._late_ns.clear()

    @property
    def is_free(self) -> bool:
        """Whether periods run without deadlines."""
        return not self._period_ns

    @property
    def deadline_ns(self) -> int:
        """Deadline of the next period (ns), computed from the origin so that it does not drift."""
        origin_ns, count = self._next
        return origin_ns + round(count * self._period_ns)

    @property
    def due_ns(self) -> int:
        """Deadline of the present period (ns), after any dropped ones."""
        return self.deadline_ns - round(self._period_ns)

    def due(self) -> bool:
        """Whether a period is due now; if so, it is counted as run."""
        if self.is_free:
            return True
        late = self.clock() - self.deadline_ns
        if late < 0:
            return False
        self._late_ns.append(late)
        given_up = int(max(late - self._catch_up_ns, 0) / self._period_ns)
        self.overruns += given_up
        origin_ns, count = self._next
        self._next = (origin_ns, count + 1 + given_up)
        return True

    def wait(self) -> None:
        """Sleep until the next deadline, for LONGEST_NAP_NS at most.

        If there is no time left, sleep for REST once every LONGEST_BUSY_NS.
        """
        now = self.clock()
        ahead = 0 if self.is_free else self.deadline_ns - now
        if ahead > 0:
            self.sleep(min(ahead, LONGEST_NAP_NS) / NANOSECONDS)
        elif now - self._rested_ns > LONGEST_BUSY_NS:
            self.sleep(REST)
        else:
            return
        self._rested_ns = self.clock()

    def lateness(self) -> tuple[float, float, float]:
        """Median, 99th percentile and maximum lateness (s) since the last call; nan if none."""
        if not self._late_ns:
            return (math.nan,) * len(PERCENTILES)
        median, most, maximum = np.percentile(self._late_ns, PERCENTILES) / NANOSECONDS
        self._late_ns.clear()
        return float(median), float(most), float(maximum)
