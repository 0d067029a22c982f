"""How long a command takes to show in what the simulator publishes."""

import random
import time

from std_msgs.msg import Float64

from benchmarks.peer import Peer
from benchmarks.processes import simulator
from benchmarks.report import MILLI, percentile

TITLE = "From a command to its effect"
ABOUT = (
    "From publishing a `steering_cmd` in another process, at random times, to receiving there the "
    "first `applied_command` that has it, in the set of the first `state` that was driven with it. "
    "A command waits for the next period, any time up to a whole one: half a period at the median, "
    "99 % of one at p99. The last columns are what remains when that is taken off."
)
COLUMNS = {
    "rate_hz": "publish rate (Hz)",
    "commands": "commands",
    "unanswered": "unanswered",
    "p50_ms": "p50 (ms)",
    "p99_ms": "p99 (ms)",
    "waiting_p50_ms": "of it the period, p50",
    "waiting_p99_ms": "p99",
    "beyond_p50_ms": "beyond it, p50",
    "beyond_p99_ms": "p99",
}
RATES = (100.0, 1000.0)
"""Hz"""
COMMANDS, QUICK = 1000, 100
SMALLEST_ANGLE = 1e-6
"""rad: every command is a multiple of it, none the same as another."""
ANSWER = 1.0
"""s until a command counts as unanswered."""
SETTLING = 0.5
"""s"""


def measure(quick: bool) -> list[dict]:
    """Rows of the table."""
    return [_row(rate, latencies(rate, QUICK if quick else COMMANDS)) for rate in RATES]


def _row(rate: float, took: list[float]) -> dict:
    """took: latencies (s), infinite where no answer came."""
    answered = [each for each in took if each < ANSWER]
    row = {"rate_hz": rate, "commands": len(took), "unanswered": len(took) - len(answered)}
    for share in (50, 99):
        row[f"p{share}_ms"] = percentile(answered, share) * MILLI
        row[f"waiting_p{share}_ms"] = share / 100 / rate * MILLI
        row[f"beyond_p{share}_ms"] = row[f"p{share}_ms"] - row[f"waiting_p{share}_ms"]
    return row


class Commander:
    """Sends steering angles, and notes when they come back as applied."""

    def __init__(self, peer: Peer):
        self._peer, self._publisher = peer, peer.commander("steering_cmd")
        self._angle = self._came = None
        self.heard = peer.listen("applied_command", self._receive)
        peer.wait(self._publisher.get_subscription_count, "a simulator")
        peer.wait(self.heard.get_publisher_count, "applied_command")

    def _receive(self, message) -> None:
        if self._came is None and message.data[1] == self._angle:
            self._came = time.perf_counter()

    def latency(self, angle: float) -> float:
        """s, ANSWER if it does not come."""
        self._angle, self._came = angle, None
        sent = time.perf_counter()
        self._publisher.publish(Float64(data=angle))
        while self._came is None and time.perf_counter() - sent < ANSWER:
            self._peer.spin()
        return (self._came - sent) if self._came else ANSWER


def latencies(rate: float, count: int) -> list[float]:
    """Of so many commands (s), sent one to two periods after the one before was answered."""
    chance = random.Random(1)
    with Peer() as peer, simulator(peer.domain, f"publish_rate:={rate}"):
        commander = Commander(peer)
        peer.spin_for(SETTLING)
        took = []
        for number in range(1, count + 1):
            peer.spin_for(chance.uniform(1.0, 2.0) / rate)
            took.append(commander.latency(number * SMALLEST_ANGLE))
    return took
