"""Status of a session, in words, for diagnostics."""

import enum
from collections.abc import Mapping, Sequence

from vehicle_roll_sim.live.channels import OF_ROAD, SPEED, WIND, Channel, Traffic
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import Condition

NOTHING = "none"

Publishers = Mapping[str, Sequence[str]]
"""Names of the nodes that publish each command, by topic."""


class Level(enum.IntEnum):
    """Severity of a status."""

    OK = 0
    WARN = 1
    ERROR = 2


def verdict(session: Session, troubles: Sequence[str]) -> tuple[Level, str]:
    """The severity of the status, and its message in one line.

    troubles: problems other than those of the model.
    """
    if session.stopped:
        return Level.ERROR, "; ".join([f"{ending(session)}: reset to go on", *troubles])
    if troubles:
        return Level.WARN, "; ".join(troubles)
    return Level.OK, "paused" if session.paused else "running"


def ending(session: Session) -> str:
    """The reason and the time at which the model stopped."""
    condition, time = session.simulation.condition, session.simulation.time
    cause = condition.name.lower().replace("_", " ")
    if condition is Condition.DIVERGED:
        cause += f" ({session.simulation.implausible})"
    return f"{cause} at {time:.3f} s"


def command_troubles(session: Session, publishers: Publishers) -> list[str]:
    """Problems with the commands: a topic is silent or ignored, or has several publishers."""
    troubles = []
    for topic, channel in session.inbox.channels.items():
        if session.inbox.is_silent(channel, session.simulation.time_ns):
            timeout, instead = session.inbox.timeout, _instead(channel, session)
            source = channel.source
            troubles.append(f"{source}: no message within {timeout:g} s of simulation: {instead}")
        if reason := _ignored(topic, channel, session):
            troubles.append(f"{channel.source}: ignored{reason}")
    for topic in session.inbox.topics:
        names = publishers.get(topic, ())
        if len(names) > 1:
            listed = ", ".join(names)
            troubles.append(f"{topic}: {len(names)} publishers, the last message wins: {listed}")
    return troubles


def _ignored(topic: str, channel: Channel, session: Session) -> str:
    """Why a command in force is ignored, or ''."""
    inbox, now = session.inbox, session.simulation.time_ns
    if not inbox.is_in_force(topic, now):
        return ""
    if winner := inbox.overruled_by(topic, now):
        return f" while {inbox.channels[winner].source} is commanded"
    feels_wind, takes_road = session.simulation.takes
    if channel.field in OF_ROAD and not takes_road:
        return ", the road does not take it"
    return ", the vehicle has no air forces" if channel.field == WIND and not feels_wind else ""


def step_trouble(session: Session) -> str:
    """A text if the step has become unstable since the start, else ''."""
    simulation = session.simulation
    step = simulation.step_ns / NANOSECONDS
    largest = simulation.largest_stable_step(simulation.acting(session.applied))
    return f"the step, {step:g} s, is unstable here above {largest:.2g} s" if step > largest else ""


def _instead(channel: Channel, session: Session) -> str:
    """What is applied instead of the command of a silent topic."""
    if channel.is_steering:
        return f"steering follows the policy {session.inbox.steering_policy}"
    if channel.field in OF_ROAD:
        return "the road stays as it is"
    return "no speed is held" if channel.field == SPEED else "0 is applied"


def model_values(session: Session) -> dict[str, str]:
    """Keys and values on the model, for diagnostics."""
    simulation = session.simulation
    return {
        "condition": simulation.condition.name.lower(),
        "implausible state": simulation.implausible or NOTHING,
        "paused": str(session.paused).lower(),
        "simulated time (s)": f"{simulation.time:.3f}",
    }


def command_values(session: Session, publishers: Publishers) -> dict[str, str]:
    """Counts, last problem, age and publishers of every command topic, for diagnostics."""
    values = {}
    for topic, traffic in session.inbox.topics.items():
        if topic in session.inbox.ways and topic not in publishers:
            continue  # its message package is not installed
        names = publishers.get(topic, ())
        values |= {
            f"{topic} received": str(traffic.received),
            f"{topic} dropped": str(traffic.dropped),
            f"{topic} clamped": str(traffic.clamped),
            f"{topic} last problem": traffic.last_problem or NOTHING,
            f"{topic} age (s)": _age(topic, traffic, session.simulation.time_ns),
            f"{topic} publishers": str(len(names)),
            f"{topic} publisher names": ", ".join(names) or NOTHING,
        }
    return values


def _age(topic: str, traffic: Traffic, now_ns: int) -> str:
    """Simulated time (s) since the last valid message on a topic.

    `none` if there was none since the reset, or a later one in another way.
    """
    if traffic.arrival_ns is None or getattr(traffic, "source", topic) != topic:
        return NOTHING
    return f"{(now_ns - traffic.arrival_ns) / NANOSECONDS:.3f}"
