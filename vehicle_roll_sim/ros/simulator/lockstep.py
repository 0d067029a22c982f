"""Runs a simulator in lockstep with its controllers: one period per answer, never by the clock."""

import time
from collections.abc import Mapping, Sequence

from rclpy.executors import Executor

from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.ros.compatibility import command_publishers
from vehicle_roll_sim.ros.node_main import LOOK

STOP = "stop"
"""Timeout policy, besides command_inbox.HOLD, when no answer comes in time."""
SETTLING = 0.2
"""Time (s) to keep spinning once all partners are found: they may find us a little later."""
COMPLAINT_INTERVAL = 5.0
"""Interval (s) between log messages about what lockstep is waiting for."""
LONG_WAIT = 2.0
"""Time (s) after which waiting becomes a warning in the diagnostics."""
LONGEST_RECEIPT = 10.0
"""Longest wait (s) for all subscribers to acknowledge the first set."""
LAST_LOOK = 0.02
"""Time (s) to read on before giving up: an answer that has arrived unread is not late."""
SHARE = 0.1
"""How late the timeout may be noticed, as a fraction of it."""


class UnansweredError(Exception):
    """A controller did not answer in time; the text names the topic."""


class Lockstep:
    """Publishes a set, waits for one message on each of `topics`, runs a period, and repeats.

    It begins when each of `topics` has a publisher and each of `listened` a subscriber. timeout:
    wall time (s) to wait for an answer, 0: forever. After that, the policy `hold` continues with
    the last command, so that a late answer counts for the next period; `stop` raises
    UnansweredError.
    """

    def __init__(self, topics: Sequence[str], listened: Sequence[str], timeout: float, policy: str):
        self.topics, self.listened = tuple(topics), tuple(listened)
        self.timeout, self.policy = timeout, policy
        self._timeouts = self._timeouts_told = 0
        self._awaited: Sequence[str] = ()
        self.restart()

    def run(self, simulator, executor: Executor) -> None:
        """Run until the context is shut down, which raises ExternalShutdownException."""
        self._await_partners(simulator, executor)
        simulator.begin()
        self._await_receipts(simulator, executor)
        while True:
            self._await_answers(simulator, executor)
            with simulator.lock:
                simulator.run_period()

    def _await_partners(self, simulator, executor: Executor) -> None:
        while missing := self._missing(simulator):
            self._awaited = missing
            simulator.get_logger().info(
                f"lockstep: waiting for {' and '.join(missing)}",
                throttle_duration_sec=COMPLAINT_INTERVAL,
            )
            executor.spin_once(timeout_sec=LOOK)
        settled = time.monotonic() + SETTLING
        while time.monotonic() < settled:
            executor.spin_once(timeout_sec=LOOK)

    def _await_receipts(self, simulator, executor: Executor) -> None:
        """Wait until all reliable subscribers have received the first set, and so will the rest.

        A subscriber that we have discovered may discover us seconds later.
        """
        until = time.monotonic() + LONGEST_RECEIPT
        while missing := simulator.unreceived():
            self._awaited = [f"a subscriber to receive {name}" for name in missing]
            if time.monotonic() > until:
                simulator.get_logger().warning(
                    f"lockstep: continuing, but a subscriber has not received {', '.join(missing)}"
                )
                return
            executor.spin_once(timeout_sec=LOOK)

    def _missing(self, simulator) -> list[str]:
        """What is still missing before the first set."""
        partners = simulator.missing_partners(self.topics, self.listened)
        return [*partners, "the end of the pause"] if simulator.session.paused else partners

    def _await_answers(self, simulator, executor: Executor) -> None:
        """Wait for all answers and the end of any pause, or for the timeout."""
        session, look = simulator.session, SHARE * self.timeout or None
        self.restart()
        while (missing := session.inbox.unanswered(self.topics)) or session.paused:
            waited = 0.0 if session.paused else time.monotonic() - self._asked
            if self.timeout and waited > self.timeout:
                self._read_on(session, executor)
                self._note_missing(session.inbox.unanswered(self.topics))
                return
            self._awaited = missing
            if waited > COMPLAINT_INTERVAL:
                simulator.get_logger().warning(
                    self.waiting(command_publishers(simulator)),
                    throttle_duration_sec=COMPLAINT_INTERVAL,
                )
            executor.spin_once(timeout_sec=look)

    def _read_on(self, session: Session, executor: Executor) -> None:
        """Read messages that have arrived but have not been processed yet."""
        until = time.monotonic() + LAST_LOOK
        while session.inbox.unanswered(self.topics) and time.monotonic() < until:
            executor.spin_once(timeout_sec=LAST_LOOK)

    def _note_missing(self, missing: Sequence[str]) -> None:
        """Count a period without all answers; raises UnansweredError if the policy is `stop`."""
        if not missing:
            return
        self._timeouts += 1
        if self.policy == STOP:
            topics = ", ".join(missing)
            raise UnansweredError(f"{topics}: no message within {self.timeout:g} s in lockstep")

    def restart(self) -> int:
        """Restart the timeout; returns the current time of the steady clock (ns)."""
        self._asked = time.monotonic()
        return time.monotonic_ns()

    def timing(self) -> dict[str, str]:
        """Diagnostics: periods that have run without an answer so far."""
        return {"lockstep timeouts": str(self._timeouts)}

    def trouble(self) -> str:
        """A warning if answers were missing since the last call, else ''."""
        timeouts = self._timeouts - self._timeouts_told
        self._timeouts_told = self._timeouts
        return f"no answer in time: {timeouts} periods ran with old commands" if timeouts else ""

    def waiting(self, publishers: Mapping[str, Sequence[str]]) -> str:
        """A warning about what lockstep has been waiting for, and from whom, if for long; else ''.

        publishers: names of the nodes that publish each command, by topic.
        """
        waited = time.monotonic() - self._asked
        if not self._awaited or waited < LONG_WAIT:
            return ""
        awaited = [
            _message_of(name, publishers[name]) if name in publishers else name
            for name in self._awaited
        ]
        return f"lockstep: waiting for {' and '.join(awaited)} for {waited:.0f} s"


def _message_of(topic: str, publishers: Sequence[str]) -> str:
    """The message that is awaited, and its publishers."""
    if not publishers:
        return f"a message on {topic}, which no known node publishes,"
    return f"a message on {topic} from {' or '.join(publishers)}"
