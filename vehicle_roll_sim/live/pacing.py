"""Keeping simulated time in step with a steady clock, or ahead of it."""

import math
import time
from collections import deque
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.model.integration.advance import NANOSECONDS

DEFAULT_CATCH_UP = 0.1
"""s"""
LONGEST_NAP_NS = 100_000_000
"""Sleep at a time (ns), so that a sleeper notices when it is to end."""
LONGEST_BUSY_NS = 5_000_000
"""Time without a sleep (ns) after which a rest lets other threads have their turn."""
REST = 1e-4
"""s"""
KEPT = 10_000
"""Periods whose lateness is remembered at most."""
SLOWEST_FACTOR, FASTEST_FACTOR = 0.1, 100.0
AS_FAST_AS_POSSIBLE = 0.0
PERCENTILES = (50, 99, 100)


class Pacer:
    """When the periods of `period_ns` of simulated time are due, by absolute deadlines.

    factor: simulated over real time, AS_FAST_AS_POSSIBLE for no deadlines. catch_up: what is more
    than this behind (s by the clock) is given up, so that simulated time never jumps; overruns: how
    many periods. clock: returns ns and never goes back; sleep: takes s.
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
        """The first period is due one period from now."""
        self._next = (self.clock(), 1)
        self._late_ns.clear()

    @property
    def is_free(self) -> bool:
        """Whether periods have no deadlines."""
        return not self._period_ns

    @property
    def deadline_ns(self) -> int:
        """When the next period is due; each is reckoned from the origin, so none drifts."""
        origin_ns, count = self._next
        return origin_ns + round(count * self._period_ns)

    @property
    def due_ns(self) -> int:
        """When the present period was due, those given up left out."""
        return self.deadline_ns - round(self._period_ns)

    def due(self) -> bool:
        """Whether to run a period now; it then counts as run."""
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
        """Sleep until the next deadline, or a nap towards it; when busy, rest now and then."""
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
        """Median, 99th percentile and maximum (s) since the last call; nan if nothing was run."""
        if not self._late_ns:
            return (math.nan,) * len(PERCENTILES)
        median, most, maximum = np.percentile(self._late_ns, PERCENTILES) / NANOSECONDS
        self._late_ns.clear()
        return float(median), float(most), float(maximum)
