"""What the simulator says of itself: on /diagnostics, and of misfits in the log."""

import threading
import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from vehicle_roll_sim.messages.topics import DIAGNOSTICS
from vehicle_roll_sim.model.advance import NANOSECONDS
from vehicle_roll_sim.model.events import Condition
from vehicle_roll_sim.ros.compatibility import incompatible_partners
from vehicle_roll_sim.ros.lockstep import Lockstep
from vehicle_roll_sim.ros.publications import Publications
from vehicle_roll_sim.ros.real_time import RealTime
from vehicle_roll_sim.simulation.session import Session


class Reporter:
    """Publishes diagnostics, and warns once of each partner that can never be connected.

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
        with self._lock:
            message = self._diagnostics()
        self._publisher.publish(message)
        misfits = set(incompatible_partners(self._node))
        for misfit in sorted(misfits - self._told):
            self._node.get_logger().warning(misfit)
        self._told = misfits

    def _diagnostics(self) -> DiagnosticArray:
        """One status: condition of the model, timing, and the counts of every command topic."""
        late = self._driver.trouble()
        level, message = _verdict(self._session, _step_trouble(self._session) or late)
        status = DiagnosticStatus(level=level, message=message, hardware_id="simulation")
        status.name = f"{self._node.get_fully_qualified_name()}: model"
        values = {
            "condition": self._session.simulation.condition.name.lower(),
            "simulated time (s)": f"{self._session.simulation.time:.3f}",
            "publish rate (Hz)": f"{self._rate():.1f}",
            **self._driver.timing(),
            **_command_counts(self._session),
        }
        status.values = [KeyValue(key=key, value=value) for key, value in values.items()]
        diagnostics = DiagnosticArray(status=[status])
        diagnostics.header.stamp = self._publications.present_stamp()
        return diagnostics

    def _rate(self) -> float:
        """Sets published a second since the last call (Hz)."""
        sets, now = self._publications.sets, time.monotonic()
        rate = (sets - self._sets) / (now - self._time)
        self._sets, self._time = sets, now
        return rate


def _verdict(session: Session, trouble: str) -> tuple[bytes, str]:
    condition = session.simulation.condition
    if condition is not Condition.RUNNING:
        cause = condition.name.lower().replace("_", " ")
        if condition is Condition.DIVERGED:
            cause += f" ({session.simulation.implausible})"
        return DiagnosticStatus.ERROR, f"{cause} at {session.simulation.time:.3f} s: reset to go on"
    silent = [
        topic
        for topic, channel in session.inbox.channels.items()
        if session.inbox.is_silent(channel, session.simulation.time_ns)
    ]
    if silent:
        return DiagnosticStatus.WARN, "no commands any more on " + ", ".join(silent)
    if trouble and not session.paused:
        return DiagnosticStatus.WARN, trouble
    return DiagnosticStatus.OK, "paused" if session.paused else "running"


def _step_trouble(session: Session) -> str:
    """What to say where the step has become too large since the start, else nothing."""
    simulation = session.simulation
    step = simulation.step_ns / NANOSECONDS
    largest = simulation.largest_stable_step(session.applied)
    return f"the step, {step:g} s, is unstable here above {largest:.2g} s" if step > largest else ""


def _command_counts(session: Session) -> dict[str, str]:
    counts = {}
    for topic, channel in session.inbox.channels.items():
        counts[f"{topic} received"] = str(channel.received)
        counts[f"{topic} dropped"] = str(channel.dropped)
        if channel.last_problem:
            counts[f"{topic} last problem"] = channel.last_problem
    return counts
