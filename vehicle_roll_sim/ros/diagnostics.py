"""What the simulator says of itself: on /diagnostics, and of what is new in it in the log."""

import threading
import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from vehicle_roll_sim.messages.topics import CLOCK, COMMANDS, DIAGNOSTICS
from vehicle_roll_sim.ros.compatibility import incompatible_partners, other_publishers
from vehicle_roll_sim.ros.compiling import status_name
from vehicle_roll_sim.ros.lockstep import Lockstep
from vehicle_roll_sim.ros.publications import Publications
from vehicle_roll_sim.ros.real_time import RealTime
from vehicle_roll_sim.simulation.session import Session
from vehicle_roll_sim.simulation.status import (
    command_troubles,
    command_values,
    model_values,
    step_trouble,
    verdict,
)


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
        publishers = {topic.name: other_publishers(self._node, topic) for topic in COMMANDS}
        clocks = self._clock_trouble()
        with self._lock:
            wrong = [*clocks, *command_troubles(self._session, publishers)]
            status = self._status(wrong, publishers)
        self._warn({*wrong, *incompatible_partners(self._node)})  # who is told may end the node
        diagnostics = DiagnosticArray(status=[status])
        diagnostics.header.stamp = self._publications.present_stamp()
        self._publisher.publish(diagnostics)

    def _warn(self, wrong: set[str]) -> None:
        """In the log, of what was not wrong the last time."""
        for trouble in sorted(wrong - self._told):
            self._node.get_logger().warning(trouble)
        self._told = wrong

    def _clock_trouble(self) -> list[str]:
        """Whether somebody else publishes the clock that this simulator gives."""
        others = other_publishers(self._node, CLOCK) if self._publications.own_clock else []
        if not others:
            return []
        listed = ", ".join(others)
        return [f"TWO CLOCKS: {CLOCK.name} comes from {listed} too: time jumps for all who use it"]

    def _status(self, wrong: list[str], publishers: dict[str, list[str]]) -> DiagnosticStatus:
        """Level and message, then the model, timing, and every command topic."""
        session = self._session
        passing = (step_trouble(session), self._driver.trouble())
        if not (session.paused or session.stopped):
            wrong = [*wrong, *filter(None, passing)]
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
