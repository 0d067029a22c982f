"""How a session is doing, in words for whoever watches it."""

import enum
from collections.abc import Mapping, Sequence

from vehicle_roll_sim.live.command_inbox import SPEED, Channel
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import Condition

NOTHING = "none"

Publishers = Mapping[str, Sequence[str]]
"""Names of the nodes that publish each command, by topic."""


class Level(enum.IntEnum):
    """How bad it is."""

    OK = 0
    WARN = 1
    ERROR = 2


def verdict(session: Session, troubles: Sequence[str]) -> tuple[Level, str]:
    """The worst of it, and all of it in one line. troubles: what is wrong beside the model."""
    if session.stopped:
        return Level.ERROR, "; ".join([f"{ending(session)}: reset to go on", *troubles])
    if troubles:
        return Level.WARN, "; ".join(troubles)
    return Level.OK, "paused" if session.paused else "running"


def ending(session: Session) -> str:
    """Why the model has stopped, and when."""
    condition, time = session.simulation.condition, session.simulation.time
    cause = condition.name.lower().replace("_", " ")
    if condition is Condition.DIVERGED:
        cause += f" ({session.simulation.implausible})"
    return f"{cause} at {time:.3f} s"


def command_troubles(session: Session, publishers: Publishers) -> list[str]:
    """What is wrong with the commands: a topic fell silent, or several nodes command it."""
    troubles = []
    for topic, channel in session.inbox.channels.items():
        if session.inbox.is_silent(channel, session.simulation.time_ns):
            timeout, instead = session.inbox.timeout, _instead(channel, session)
            troubles.append(f"{topic}: no message within {timeout:g} s of simulation: {instead}")
        names = publishers.get(topic, ())
        if len(names) > 1:
            listed = ", ".join(names)
            troubles.append(f"{topic}: {len(names)} publishers, the last message wins: {listed}")
    return troubles


def step_trouble(session: Session) -> str:
    """What to say where the step has become too large since the start, else nothing."""
    simulation = session.simulation
    step = simulation.step_ns / NANOSECONDS
    largest = simulation.largest_stable_step(session.applied)
    return f"the step, {step:g} s, is unstable here above {largest:.2g} s" if step > largest else ""


def _instead(channel: Channel, session: Session) -> str:
    """What a topic that fell silent has become."""
    if channel.is_steering:
        return f"steering follows the policy {session.inbox.steering_policy}"
    return "no speed is held" if channel.field == SPEED else "0 is applied"


def model_values(session: Session) -> dict[str, str]:
    simulation = session.simulation
    return {
        "condition": simulation.condition.name.lower(),
        "implausible state": simulation.implausible or NOTHING,
        "paused": str(session.paused).lower(),
        "simulated time (s)": f"{simulation.time:.3f}",
    }


def command_values(session: Session, publishers: Publishers) -> dict[str, str]:
    """Of every command topic: its counts, its last problem, its age and who publishes it."""
    values = {}
    for topic, channel in session.inbox.channels.items():
        names = publishers.get(topic, ())
        values |= {
            f"{topic} received": str(channel.received),
            f"{topic} dropped": str(channel.dropped),
            f"{topic} clamped": str(channel.clamped),
            f"{topic} last problem": channel.last_problem or NOTHING,
            f"{topic} age (s)": _age(channel, session.simulation.time_ns),
            f"{topic} publishers": str(len(names)),
            f"{topic} publisher names": ", ".join(names) or NOTHING,
        }
    return values


def _age(channel: Channel, now_ns: int) -> str:
    """Simulated time (s) since the last good message since the reset."""
    if channel.arrival_ns is None:
        return NOTHING
    return f"{(now_ns - channel.arrival_ns) / NANOSECONDS:.3f}"
