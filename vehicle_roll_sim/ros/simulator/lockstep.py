"""Runs a simulator in step with its controllers: a period for every answer, never by the clock."""

import time
from collections.abc import Mapping, Sequence

from rclpy.executors import Executor

from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.ros.compatibility import command_publishers
from vehicle_roll_sim.ros.process import LOOK

STOP = "stop"
"""The other policy beside command_inbox.HOLD, when no answer comes in time."""
SETTLING = 0.2
"""s to go on listening when all partners are found: they may find us a little later."""
COMPLAINT_INTERVAL = 5.0
"""s between two lines on what is waited for."""
LONG_WAIT = 2.0
"""s after which what is waited for is a warning in the diagnostics."""
LONGEST_RECEIPT = 10.0
"""s until a listener that does not take the first set is waited for no longer."""
LAST_LOOK = 0.02
"""s to go on reading before giving up: what has come is not late because it was not read."""
SHARE = 0.1
"""Of the time for an answer: by so much the end of it may be noticed late."""


class UnansweredError(Exception):
    """A controller did not answer in time; the text names the topic."""


class Lockstep:
    """Publishes a set, waits for one message on each of `topics`, runs a period, and so on.

    It begins when every topic has a publisher and each of `listened` a listener. timeout: wall
    seconds to wait for an answer, 0 for ever; then the policy `hold` goes on with the last command,
    so that a late answer counts for the next period, and `stop` raises UnansweredError.
    """

    def __init__(self, topics: Sequence[str], listened: Sequence[str], timeout: float, policy: str):
        self.topics, self.listened = tuple(topics), tuple(listened)
        self.timeout, self.policy = timeout, policy
        self._timeouts = self._timeouts_told = 0
        self._awaited: Sequence[str] = ()
        self.restart()

    def run(self, simulator, executor: Executor) -> None:
        """Until the context is shut down, which raises ExternalShutdownException."""
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
        """Until all reliable listeners have the first set, and so will have what follows.

        Those that are known here may know of this simulator seconds later.
        """
        until = time.monotonic() + LONGEST_RECEIPT
        while missing := simulator.unreceived():
            self._awaited = [f"a listener to receive {name}" for name in missing]
            if time.monotonic() > until:
                simulator.get_logger().warning(
                    f"lockstep: goes on, though a listener has not received {', '.join(missing)}"
                )
                return
            executor.spin_once(timeout_sec=LOOK)

    def _missing(self, simulator) -> list[str]:
        """What stands in the way of the first set."""
        partners = simulator.missing_partners(self.topics, self.listened)
        return [*partners, "the end of the pause"] if simulator.session.paused else partners

    def _await_answers(self, simulator, executor: Executor) -> None:
        """Until all answers are there and nobody has paused, or the time for them is over."""
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
        """Take what has come but has not been read yet."""
        until = time.monotonic() + LAST_LOOK
        while session.inbox.unanswered(self.topics) and time.monotonic() < until:
            executor.spin_once(timeout_sec=LAST_LOOK)

    def _note_missing(self, missing: Sequence[str]) -> None:
        """Count a period without all answers; raises UnansweredError if the policy says so."""
        if not missing:
            return
        self._timeouts += 1
        if self.policy == STOP:
            topics = ", ".join(missing)
            raise UnansweredError(f"{topics}: no message within {self.timeout:g} s of lockstep")

    def restart(self) -> int:
        """The time for an answer begins anew; returns the present by the steady clock (ns)."""
        self._asked = time.monotonic()
        return time.monotonic_ns()

    def timing(self) -> dict[str, str]:
        """Periods run without an answer so far."""
        return {"lockstep timeouts": str(self._timeouts)}

    def trouble(self) -> str:
        """What went wrong since the last call, or ''."""
        timeouts = self._timeouts - self._timeouts_told
        self._timeouts_told = self._timeouts
        return f"no answer in time: {timeouts} periods with the last command" if timeouts else ""

    def waiting(self, publishers: Mapping[str, Sequence[str]]) -> str:
        """What has been waited for so long that it is worth a word, and of whom; else ''.

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
    """A message that is waited for, and whose it is."""
    if not publishers:
        return f"a message on {topic}, which no known node publishes,"
    return f"a message on {topic} from {' or '.join(publishers)}"
