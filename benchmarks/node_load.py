"""The cost of running the node: CPU time, lateness and lost messages by publish rate."""

import math
import time

from benchmarks.peer import Peer, Tap, wait
from benchmarks.processes import processor_seconds, simulator
from benchmarks.report import median

TITLE = "The node by publish rate"
ABOUT = (
    "A simulator in one process, and in another one subscriber to `state`, `imu`, "
    "`tire_normal_forces` and `lift_off`. CPU: share of one core that the simulator uses, user and "
    "system time. Sets: received, as a share of those due by the clock. Lateness in every second, "
    "and overruns: from `/diagnostics`; p50 and p99 are medians over the seconds. Lost: messages "
    "that were sent but not received."
)
COLUMNS = {
    "case": "publish rate",
    "cpu_percent": "CPU (%)",
    "sets_percent": "sets (%)",
    "simulated_over_wall": "simulated / wall time",
    "lateness_p50_ms": "late p50 (ms)",
    "lateness_p99_ms": "p99",
    "lateness_max_ms": "max",
    "overruns": "overruns",
    "lost": "lost",
}
LISTENED = ("state", "imu", "tire_normal_forces", "lift_off")
CASES = {
    "100 Hz": (100.0, 1.0, LISTENED),
    "200 Hz": (200.0, 1.0, LISTENED),
    "1000 Hz": (1000.0, 1.0, LISTENED),
    "100 Hz, real_time_factor 10": (100.0, 10.0, LISTENED),
    "100 Hz, real_time_factor 0": (100.0, 0.0, LISTENED),
    "the same, no subscribers": (100.0, 0.0, ()),
}
"""Publish rate (Hz), real_time_factor, topics subscribed to."""
WARM_UP = 2.0
"""s"""
DURATION, QUICK = 20.0, 5.0
"""s"""
LOOK = 0.005
"""Poll interval (s)."""


def measure(quick: bool) -> list[dict]:
    """Rows of the table."""
    duration = QUICK if quick else DURATION
    return [{"case": name, **load(*case, duration)} for name, case in CASES.items()]


def load(rate: float, factor: float, listened: tuple[str, ...], duration: float) -> dict:
    """The figures of one simulator, observed for `duration` (s)."""
    parameters = (f"publish_rate:={rate}", f"real_time_factor:={factor}")
    with Peer() as peer, simulator(peer.domain, *parameters) as process:
        diagnostics = Tap(peer, "/diagnostics", keep=True)
        sets = [Tap(peer, name) for name in listened]
        taps = [diagnostics, *sets]
        for tap in taps:
            wait(tap.found, f"a message on {tap.name}", lambda: time.sleep(LOOK))
        _drain_for(WARM_UP, taps)
        for tap in taps:
            tap.clear()
        begun, used = time.monotonic(), processor_seconds(process.pid)
        _drain_for(duration, taps)
        used, lasted = processor_seconds(process.pid) - used, time.monotonic() - begun
    due = rate * factor * lasted
    return {
        "cpu_percent": 100.0 * used / lasted,
        "sets_percent": 100.0 * sets[0].count / due if due else math.nan,
        "simulated_over_wall": _pace(diagnostics),
        **_timing(diagnostics),
        "lost": sum(tap.lost for tap in taps),
    }


def _drain_for(duration: float, taps: list[Tap]) -> None:
    until = time.monotonic() + duration
    while time.monotonic() < until:
        time.sleep(LOOK)
        for tap in taps:
            tap.drain()


def _values(message) -> dict[str, str]:
    return {item.key: item.value for item in message.status[0].values}


def _pace(diagnostics: Tap) -> float:
    """Simulated over wall time, from the first to the last diagnostics message."""
    (first, began), (last, ended) = map(diagnostics.decoded, (diagnostics.first, diagnostics.last))
    simulated = [float(_values(message)["simulated time (s)"]) for message in (first, last)]
    return (simulated[1] - simulated[0]) / (ended - began)


def _timing(diagnostics: Tap) -> dict:
    """Lateness and overruns from the diagnostics."""
    seconds = [_values(diagnostics.decoded(taken)[0]) for taken in diagnostics.kept]
    p50, p99, most = (
        [float(second[name]) for second in seconds]
        for name in ("lateness p50 (ms)", "lateness p99 (ms)", "largest lateness (ms)")
    )
    return {
        "lateness_p50_ms": median(p50),
        "lateness_p99_ms": median(p99),
        "lateness_max_ms": max(most),
        "overruns": int(seconds[-1]["overruns"]) - int(seconds[0]["overruns"]),
    }
