"""What the simulator says of itself: on /diagnostics, and of what is new in it in the log."""

import threading
import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.live.status import (
    command_troubles,
    command_values,
    model_values,
    step_trouble,
    verdict,
)
from vehicle_roll_sim.messages.collected import STATE
from vehicle_roll_sim.messages.topics import CLOCK, DIAGNOSTICS, STATE_SET
from vehicle_roll_sim.ros.compatibility import (
    command_publishers,
    incompatible_partners,
    other_publishers,
)
from vehicle_roll_sim.ros.simulator.compiling import status_name
from vehicle_roll_sim.ros.simulator.lockstep import Lockstep
from vehicle_roll_sim.ros.simulator.publications import Publications
from vehicle_roll_sim.ros.simulator.real_time import RealTime

MOST_LISTED = 3
"""Topics that a warning names; of more it says how many."""


class Reporter:
    """Publishes diagnostics, and warns in the log when something new is wrong.

    lock: to be held while the session is looked at.
    """

    def __init__(
        self,
        node: Node,
        session: Session,
        driver: RealTime | Lockstep,
        publications: Publications,
        lock: threading.Lock,
    ):
        self._node, self._session, self._driver = node, session, driver
        self._publications, self._lock = publications, lock
        self._publisher = publications.publisher(DIAGNOSTICS)
        self._told: set[str] = set()
        self._sets, self._time = 0, time.monotonic()

    def report(self) -> None:
        publishers = command_publishers(self._node)
        others = [*self._clock_trouble(), *self._doubled()]
        with self._lock:
            is_idle = self._session.paused or self._session.stopped
            wrong = [*others, *command_troubles(self._session, publishers)]
            late = self._driver.trouble()
            passing = (step_trouble(self._session), late, self._driver.waiting(publishers))
            status = self._status([*wrong, *("" if is_idle else filter(None, passing))], publishers)
        self._warn({*wrong, *incompatible_partners(self._node)})  # who is told may end the node
        if late and not is_idle:
            self._node.get_logger().warning(late)
        diagnostics = DiagnosticArray(status=[status])
        diagnostics.header.stamp = self._publications.present_stamp()
        self._publisher.publish(diagnostics)

    def _warn(self, wrong: set[str]) -> None:
        """In the log, of what was not wrong the last time."""
        for trouble in sorted(wrong - self._told):
            self._node.get_logger().warning(trouble)
        self._told = wrong

    def _clock_trouble(self) -> list[str]:
        """Whether stamps are off the clock, or somebody else publishes the one that is ours."""
        troubles = [self._publications.clock_trouble()]
        if self._publications.own_clock and (others := other_publishers(self._node, CLOCK)):
            listed = ", ".join(others)
            troubles.append(
                f"TWO CLOCKS: {CLOCK.name} comes from {listed} too: time jumps for all who use it"
            )
        return [*filter(None, troubles)]

    def _doubled(self) -> list[str]:
        """Which other nodes publish topics of the set, one line for each."""
        topics_of: dict[str, list[str]] = {}
        for topic in STATE_SET:
            if self._node.count_publishers(self._node.resolve_topic_name(topic.name)) > 1:
                for name in other_publishers(self._node, topic):
                    topics_of.setdefault(name, []).append(topic.name)
        return [_doubled_by(name, topics) for name, topics in sorted(topics_of.items())]

    def _status(self, wrong: list[str], publishers: dict[str, list[str]]) -> DiagnosticStatus:
        """Level and message, then the model, timing, and every command topic."""
        session = self._session
        level, message = verdict(session, wrong)
        status = DiagnosticStatus(level=bytes([level]), message=message, hardware_id="simulation")
        status.name = status_name(self._node.get_fully_qualified_name())
        values = {
            **model_values(session),
            "publish rate (Hz)": f"{self._rate():.1f}",
            **self._driver.timing(),
            **command_values(session, publishers),
        }
        status.values = [KeyValue(key=key, value=value) for key, value in values.items()]
        return status

    def _rate(self) -> float:
        """Sets published a second since the last call (Hz)."""
        sets, now = self._publications.sets, time.monotonic()
        rate = (sets - self._sets) / (now - self._time)
        self._sets, self._time = sets, now
        return rate


def _doubled_by(node: str, topics: list[str]) -> str:
    """What to say of a node that publishes topics of the set, too."""
    more = len(topics) - MOST_LISTED
    listed = ", ".join(topics[:MOST_LISTED]) + (f" and {more} more topics" if more > 0 else "")
    trouble = f"{node} publishes {listed} too: listeners get both; a namespace separates them"
    return f"TWO SIMULATORS: {trouble}" if STATE in topics else trouble
