"""What the simulator says of itself on /diagnostics."""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from vehicle_roll_sim.model.events import Condition
from vehicle_roll_sim.simulation.pacing import Pacer
from vehicle_roll_sim.simulation.session import Session

MILLISECOND = 1e6
"""ns"""


def diagnostics(
    name: str, session: Session, pacer: Pacer, measured_rate: float, new_overruns: int
) -> DiagnosticArray:
    """One status: condition of the model, timing, and the counts of every command topic.

    measured_rate, new_overruns: sets published a second and periods given up since the last
    report. The stamp is left to the caller.
    """
    level, message = _verdict(session, new_overruns)
    values = {
        "condition": session.simulation.condition.name.lower(),
        "simulated time (s)": f"{session.simulation.time:.3f}",
        "publish rate (Hz)": f"{measured_rate:.1f}",
        "largest lateness (ms)": f"{pacer.largest_late_ns / MILLISECOND:.3f}",
        "overruns": str(pacer.overruns),
        **_command_counts(session),
    }
    status = DiagnosticStatus(level=level, name=name, message=message, hardware_id="simulation")
    status.values = [KeyValue(key=key, value=value) for key, value in values.items()]
    return DiagnosticArray(status=[status])


def _verdict(session: Session, new_overruns: int) -> tuple[bytes, str]:
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
    if new_overruns:
        return DiagnosticStatus.WARN, f"too slow a machine: {new_overruns} periods given up"
    return DiagnosticStatus.OK, "paused" if session.paused else "running"


def _command_counts(session: Session) -> dict[str, str]:
    counts = {}
    for topic, channel in session.inbox.channels.items():
        counts[f"{topic} received"] = str(channel.received)
        counts[f"{topic} dropped"] = str(channel.dropped)
        if channel.last_problem:
            counts[f"{topic} last problem"] = channel.last_problem
    return counts
