"""The simulator's status: on /diagnostics, with every new problem also in the log."""

import threading
import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from vehicle_roll_sim.live.status import (
    command_troubles,
    command_values,
    model_values,
    step_trouble,
    verdict,
)
from vehicle_roll_sim.messages.run_messages import STATE
from vehicle_roll_sim.messages.topics import CLOCK, DIAGNOSTICS, set_of
from vehicle_roll_sim.ros.compatibility import (
    command_publishers,
    incompatible_partners,
    other_publishers,
)
from vehicle_roll_sim.ros.simulator.compile_status import status_name
from vehicle_roll_sim.ros.simulator.lockstep import Lockstep
from vehicle_roll_sim.ros.simulator.publications import Publications
from vehicle_roll_sim.ros.simulator.real_time import RealTime

MOST_LISTED = 3
"""Number of topics that a warning lists by name; the rest are counted."""


class Reporter:
    """Publishes diagnostics of a simulator node, and logs a warning for each new problem.

    lock: held while the session of the node is read.
    """

    def __init__(
        self,
        node: Node,
        driver: RealTime | Lockstep,
        publications: Publications,
        lock: threading.Lock,
    ):
        self._node, self._driver = node, driver
        self._publications, self._lock = publications, lock
        self._publisher = publications.publisher(DIAGNOSTICS)
        self._told: set[str] = set()
        self._sets, self._time = 0, time.monotonic()

    def report(self) -> None:
        """Publish the current status and log what is new in it."""
        publishers = command_publishers(self._node)
        others = [*self._clock_trouble(), *self._doubled()]
        with self._lock:
            is_idle = self._node.session.paused or self._node.session.stopped
            wrong = [*others, *command_troubles(self._node.session, publishers)]
            late = self._driver.trouble()
            passing = (step_trouble(self._node.session), late, self._driver.waiting(publishers))
            status = self._status([*wrong, *("" if is_idle else filter(None, passing))], publishers)
        self._warn({*wrong, *incompatible_partners(self._node)})  # a log handler may end the node
        if late and not is_idle:
            self._node.get_logger().warning(late)
        diagnostics = DiagnosticArray(status=[status])
        diagnostics.header.stamp = self._publications.present_stamp()
        self._publisher.publish(diagnostics)

    def _warn(self, wrong: set[str]) -> None:
        """Log each problem that was not present in the previous report."""
        for trouble in sorted(wrong - self._told):
            self._node.get_logger().warning(trouble)
        self._told = wrong

    def _clock_trouble(self) -> list[str]:
        """Warnings about stamps that differ from the clock, and about a second /clock publisher."""
        troubles = [self._publications.clock_trouble()]
        if self._publications.own_clock and (others := other_publishers(self._node, CLOCK)):
            listed = ", ".join(others)
            troubles.append(
                f"TWO CLOCKS: {listed} also publishes {CLOCK.name}: time jumps for all its users"
            )
        return [*filter(None, troubles)]

    def _doubled(self) -> list[str]:
        """One warning for each other node that publishes topics of the set."""
        topics_of: dict[str, list[str]] = {}
        simulation = self._node.session.simulation
        parts = (simulation.sensors.devices, simulation.has_actuators)
        for topic in set_of(simulation.options, False, *parts):
            if self._node.count_publishers(self._node.resolve_topic_name(topic.name)) > 1:
                for name in other_publishers(self._node, topic):
                    topics_of.setdefault(name, []).append(topic.name)
        return [_doubled_by(name, topics) for name, topics in sorted(topics_of.items())]

    def _status(self, wrong: list[str], publishers: dict[str, list[str]]) -> DiagnosticStatus:
        """The status: level and message, then values of the model, timing and command topics."""
        session = self._node.session
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
        """Sets published per second since the last call (Hz)."""
        sets, now = self._publications.sets, time.monotonic()
        rate = (sets - self._sets) / (now - self._time)
        self._sets, self._time = sets, now
        return rate


def _doubled_by(node: str, topics: list[str]) -> str:
    """The warning about another node that publishes topics of the set."""
    more = len(topics) - MOST_LISTED
    listed = ", ".join(topics[:MOST_LISTED]) + (f" and {more} more topics" if more > 0 else "")
    trouble = f"{node} also publishes {listed}: subscribers get both; separate them by namespace"
    return f"TWO SIMULATORS: {trouble}" if STATE in topics else trouble
