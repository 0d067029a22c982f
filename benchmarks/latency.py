"""Latency from a command to the first published message that shows it."""

import random
import time

from std_msgs.msg import Float64

from benchmarks.peer import Peer
from benchmarks.processes import simulator
from benchmarks.report import MILLI, percentile

TITLE = "From a command to its effect"
ABOUT = (
    "Time from publishing a `steering_cmd` in another process, at a random moment, to receiving "
    "there the first `applied_command` with its value, in the set of the first `state` that it "
    "affected. A command waits up to one period for the next one to begin: half a period at the "
    "median, 99 % of one at p99. The last two columns are the latency without this wait."
)
COLUMNS = {
    "rate_hz": "publish rate (Hz)",
    "commands": "commands",
    "unanswered": "unanswered",
    "p50_ms": "p50 (ms)",
    "p99_ms": "p99 (ms)",
    "waiting_p50_ms": "wait for the period, p50 (ms)",
    "waiting_p99_ms": "p99 (ms)",
    "beyond_p50_ms": "without the wait, p50 (ms)",
    "beyond_p99_ms": "p99 (ms)",
}
RATES = (100.0, 1000.0)
"""Hz"""
COMMANDS, QUICK = 1000, 100
SMALLEST_ANGLE = 1e-6
"""rad: commands are different multiples of it."""
ANSWER = 1.0
"""s until a command counts as unanswered."""
SETTLING = 0.5
"""s"""


def measure(quick: bool) -> list[dict]:
    """Rows of the table."""
    return [_row(rate, latencies(rate, QUICK if quick else COMMANDS)) for rate in RATES]


def _row(rate: float, took: list[float]) -> dict:
    """A row of the table. took: latencies (s), ANSWER or more if there was no answer."""
    answered = [each for each in took if each < ANSWER]
    row = {"rate_hz": rate, "commands": len(took), "unanswered": len(took) - len(answered)}
    for share in (50, 99):
        row[f"p{share}_ms"] = percentile(answered, share) * MILLI
        row[f"waiting_p{share}_ms"] = share / 100 / rate * MILLI
        row[f"beyond_p{share}_ms"] = row[f"p{share}_ms"] - row[f"waiting_p{share}_ms"]
    return row


class Commander:
    """Sends steering angles, and notes when they are published as applied."""

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
        """The latency of one command (s), ANSWER if it is not answered."""
        self._angle, self._came = angle, None
        sent = time.perf_counter()
        self._publisher.publish(Float64(data=angle))
        while self._came is None and time.perf_counter() - sent < ANSWER:
            self._peer.spin()
        return (self._came - sent) if self._came else ANSWER


def latencies(rate: float, count: int) -> list[float]:
    """Latencies (s) of `count` commands, each sent one to two periods after the previous answer."""
    chance = random.Random(1)
    with Peer() as peer, simulator(peer.domain, f"publish_rate:={rate}"):
        commander = Commander(peer)
        peer.spin_for(SETTLING)
        took = []
        for number in range(1, count + 1):
            peer.spin_for(chance.uniform(1.0, 2.0) / rate)
            took.append(commander.latency(number * SMALLEST_ANGLE))
    return took
