"""The speed of lockstep, compared with two processes that only exchange the same messages."""

import math
import time

from std_msgs.msg import Float64

from benchmarks.peer import Peer
from benchmarks.processes import running, simulator
from benchmarks.report import median

TITLE = "Lockstep"
ABOUT = (
    "Periods per second, each of 10 ms in ten steps, with a controller in another process that "
    "answers every `state` with a `steering_cmd`. For comparison, the same controller with a bare "
    "node, which has no model, parameters or services and only sends the same bytes (the least "
    "that rclpy can do), and with a plain node that publishes message objects. Measured in turn; "
    "medians."
)
COLUMNS = {
    "topics": "subscribed",
    "periods": "periods",
    "repetitions": "repetitions",
    "simulator_hz": "simulator (1/s)",
    "bare_hz": "bare (1/s)",
    "plain_hz": "plain node (1/s)",
    "of_bare_percent": "of bare (%)",
    "of_plain_percent": "of plain (%)",
}
LISTENED = (("state",), ("state", "imu", "tire_normal_forces"))
PARTNERS = ("simulator", "bare", "plain")
WARM_UP = 500
"""Periods before timing starts."""
REPETITIONS, QUICK = 5, 1
PERIODS, QUICK_PERIODS = 5000, 1000
LARGEST_ANGLE = 0.02
"""rad"""


def measure(quick: bool) -> list[dict]:
    """Rows of the table."""
    repetitions = QUICK if quick else REPETITIONS
    periods = QUICK_PERIODS if quick else PERIODS
    return [compare(listened, repetitions, periods) for listened in LISTENED]


def compare(listened: tuple[str, ...], repetitions: int, periods: int) -> dict:
    """A row of the table: rates with all partners, for a controller that hears these topics."""
    rates = {partner: [] for partner in PARTNERS}
    for _ in range(repetitions):
        for partner, found in rates.items():
            found.append(rate(partner, listened, periods))
    simulator_hz, bare_hz, plain_hz = (median(found) for found in rates.values())
    return {
        "topics": ", ".join(listened),
        "periods": periods,
        "repetitions": repetitions,
        "simulator_hz": simulator_hz,
        "bare_hz": bare_hz,
        "plain_hz": plain_hz,
        "of_bare_percent": 100.0 * simulator_hz / bare_hz,
        "of_plain_percent": 100.0 * simulator_hz / plain_hz,
    }


def rate(partner: str, listened: tuple[str, ...], periods: int) -> float:
    """Periods per second."""
    with Peer() as peer:
        controller = Controller(peer, listened, WARM_UP + periods)
        with start(partner, peer.domain, listened):
            peer.wait(lambda: controller.count >= WARM_UP, f"lockstep with {partner}")
            began, before = time.perf_counter(), controller.count
            peer.wait(lambda: controller.finished, f"the end of lockstep with {partner}")
            return (controller.count - before) / (controller.finished - began)


def start(partner: str, domain: int, listened: tuple[str, ...]):
    """Start the controller's partner in a process of its own."""
    if partner == "simulator":
        waits = f"lockstep_wait:=[{', '.join(listened)}]"
        return simulator(domain, "mode:=lockstep", waits)
    return running("benchmarks.partner", partner, *listened, domain=domain)


class Controller:
    """Answers every `state` except the last. states: how many to expect; count: received so far."""

    def __init__(self, peer: Peer, listened: tuple[str, ...], states: int):
        self.count, self.finished, self._states = 0, 0.0, states
        self._publisher = peer.commander("steering_cmd")
        for name in listened:
            peer.listen(name, self._answer if name == "state" else lambda _: None)

    def _answer(self, state) -> None:
        self.count += 1
        if self.count >= self._states:
            self.finished = time.perf_counter()
            return
        self._publisher.publish(Float64(data=LARGEST_ANGLE * math.sin(state.data[0])))
