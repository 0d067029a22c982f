"""How long a simulator takes to start, and how much memory it takes."""

import tempfile
import time

from benchmarks.peer import Peer
from benchmarks.processes import peak_memory, simulator
from benchmarks.report import median

TITLE = "Start and memory"
ABOUT = (
    "Median time from the start of the process to the first `state` that a waiting subscriber "
    "receives: with the compiled model in its cache, and with an empty cache, so that the model is "
    "compiled. Memory: peak resident size of the process (VmHWM) after running at 100 Hz."
)
COLUMNS = {
    "cache": "cache",
    "starts": "starts",
    "first_state_s": "first `state` (s)",
    "running_s": "running (s)",
    "memory_mib": "memory (MiB)",
}
WARM, QUICK_WARM = 7, 2
COLD, QUICK_COLD = 3, 1
RUNNING, QUICK_RUNNING = 60.0, 5.0
"""s"""


def measure(quick: bool) -> list[dict]:
    """Rows of the table."""
    begin({}, 0.0)  # fills the cache if it is empty
    warm = [begin({}, 0.0) for _ in range((QUICK_WARM if quick else WARM) - 1)]
    running = QUICK_RUNNING if quick else RUNNING
    warm.append(begin({}, running))
    cold = [begin_cold() for _ in range(QUICK_COLD if quick else COLD)]
    return [_row("warm", warm, running), _row("cold", cold, 0.0)]


def _row(cache: str, starts: list[tuple[float, float]], running: float) -> dict:
    seconds, memory = zip(*starts, strict=True)
    return {
        "cache": cache,
        "starts": len(starts),
        "first_state_s": median(seconds),
        "running_s": running,
        "memory_mib": memory[-1],
    }


def begin_cold() -> tuple[float, float]:
    """Like `begin`, but with empty caches."""
    with tempfile.TemporaryDirectory(prefix="cold-cache-") as folder:
        return begin({"XDG_CACHE_HOME": folder, "NUMBA_CACHE_DIR": ""}, 0.0)


def begin(environment: dict[str, str], running: float) -> tuple[float, float]:
    """Start a simulator and let it run for `running` (s).

    Returns the time to the first state (s) and the peak memory (MiB).
    """
    came = []
    with Peer() as peer:
        peer.listen("state", lambda _: came or came.append(time.perf_counter()))
        begun = time.perf_counter()
        with simulator(peer.domain, environment=environment) as process:
            peer.wait(lambda: came, "the first state")
            peer.spin_for(running)
            return came[0] - begun, peak_memory(process.pid)
