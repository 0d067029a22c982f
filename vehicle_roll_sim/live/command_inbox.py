"""External commands: checked on arrival, read once per period, discarded after a timeout."""

import dataclasses
from collections.abc import Sequence

from vehicle_roll_sim.live.channels import (
    CLAMPED,
    DROPPED,
    OF_ROAD,
    TOTALS,
    Channel,
    Traffic,
    channels,
)
from vehicle_roll_sim.live.command_limits import CommandLimits
from vehicle_roll_sim.live.ways_in import PARTS, Parts
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.simulation.command import Command

HOLD, CENTRE = "hold", "centre"
OVERRULED_BY = {
    "speed_cmd": ("wheel_torque_cmd", "drive_torque_cmd"),
    "drive_torque_cmd": ("wheel_torque_cmd",),
    "brake_cmd": ("brake_torque_cmd",),
}
"""The topics of totals, and those that they give way to."""
DEFAULT_TIMEOUT = 0.5
"""s of simulated time"""


class CommandInbox:
    """The latest valid command of every topic.

    timeout: simulated time (s) without a message after which a topic that had received one counts
    as silent; 0: never. The torques, active forces and wind of a silent topic become 0 and its
    speed command ends; steering follows `steering_policy`, `hold` or `centre`; the road stays as it
    is. limits: the limits applied when commands are read; by default those of CommandLimits().
    """

    def __init__(
        self,
        timeout: float = DEFAULT_TIMEOUT,
        steering_policy: str = HOLD,
        limits: CommandLimits | None = None,
    ):
        self.timeout, self.steering_policy = timeout, steering_policy
        self.limits = limits or CommandLimits()
        self.channels = channels()
        self.ways = {topic: Traffic() for topic in PARTS}
        self.topics: dict[str, Traffic] = self.channels | self.ways
        self._values, self._command = {}, Command()

    def receive(self, topic: str, values: Sequence[float], now_ns: int) -> str:
        """Store a message that arrived at simulated time `now_ns`; returns its problem, or ''."""
        return self.receive_parts(topic, {topic: values}, now_ns)

    def receive_parts(self, topic: str, parts: Parts, now_ns: int) -> str:
        """Store a message that commands one or more channels, as a whole or not at all.

        A quantity that is commanded in another way is refused until that has expired.
        """
        traffic = self._count(topic)
        for name, values in parts.items():
            channel = self.channels[name]
            flaw = channel.flaw(values) or self._conflict(channel, topic, now_ns)
            if flaw:
                about = "" if name == topic else f"{channel.field}: "
                return traffic.note(DROPPED, about + flaw)
        excess = ""
        for name, values in parts.items():
            channel = self.channels[name]
            channel.value, channel.arrival_ns, channel.source = tuple(values), now_ns, topic
            excess = excess or self.limits.excess(channel.limit, values)
        traffic.arrival_ns = now_ns
        return traffic.note(CLAMPED, excess) if excess else ""

    def drop(self, topic: str, flaw: str) -> str:
        """Count a message that cannot be used for a reason; returns its problem."""
        return self._count(topic).note(DROPPED, flaw)

    def _count(self, topic: str) -> Traffic:
        traffic = self.topics[topic]
        traffic.received += 1
        traffic.answered = True
        return traffic

    def _conflict(self, channel: Channel, topic: str, now_ns: int) -> str:
        """Why a topic may not command a channel: another one does; '' if it may."""
        if channel.source in ("", topic) or self.is_silent(channel, now_ns):
            return ""
        return f"{topic} is refused while {channel.source} commands {channel.field}"

    def command(self, now_ns: int) -> Command:
        """The command for the period that begins at simulated time `now_ns`.

        Returns the same object as before if nothing has changed. Clears `answered` of all channels.
        """
        values = {}
        self.await_answers()
        for channel in self.channels.values():
            if channel.arrival_ns is None or channel.field in TOTALS:
                continue
            silent = self.is_silent(channel, now_ns)
            value = self.limits.clamped(channel.limit, channel.value)
            if channel.is_steering:
                centred = silent and self.steering_policy == CENTRE
                values[channel.field] = 0.0 if centred else value[0]
            elif channel.field in OF_ROAD:
                values[channel.field] = value
            else:
                values[channel.field] = (0.0,) * channel.size if silent else value
        if values != self._values:
            self._values, self._command = values, Command(**values)
        return self._command

    def total(self, topic: str, now_ns: int) -> float | None:
        """The value of `speed_cmd`, `drive_torque_cmd` or `brake_cmd` (m/s, N m).

        None if there is none, or while a topic is in force that it gives way to.
        """
        channel = self.channels[topic]
        if not self.is_in_force(topic, now_ns) or self.overruled_by(topic, now_ns):
            return None
        return self.limits.clamped(channel.limit, channel.value)[0]

    def is_in_force(self, topic: str, now_ns: int) -> bool:
        """Whether a topic has received a valid message within the timeout."""
        channel = self.channels[topic]
        return channel.arrival_ns is not None and not self.is_silent(channel, now_ns)

    def overruled_by(self, topic: str, now_ns: int) -> str:
        """The topic in force that this topic gives way to, or ''."""
        others = OVERRULED_BY.get(topic, ())
        return next((other for other in others if self.is_in_force(other, now_ns)), "")

    def unanswered(self, topics: Sequence[str]) -> list[str]:
        """Those of `topics` that received no message, not even an invalid one, since `command`."""
        return [topic for topic in topics if not self.topics[topic].answered]

    def is_silent(self, channel: Channel, now_ns: int) -> bool:
        """Whether a topic has received a message before, but none within the timeout."""
        if channel.arrival_ns is None or self.timeout == 0.0:
            return False
        return now_ns - channel.arrival_ns > round(self.timeout * NANOSECONDS)

    def memory(self) -> dict:
        """What determines the next commands: values, times of arrival, timeouts and limits.

        The counts of messages are no part of it.
        """
        return {
            "timeout": self.timeout,
            "steering_policy": self.steering_policy,
            "limits": dataclasses.asdict(self.limits),
            "values": {name: [list(c.value), c.source] for name, c in self.channels.items()},
            "heard": {name: [t.arrival_ns, t.answered] for name, t in self.topics.items()},
        }

    def remember(self, memory: dict) -> None:
        """Take over what `memory` returned."""
        self.timeout, self.steering_policy = memory["timeout"], memory["steering_policy"]
        for name, limit in memory["limits"].items():
            setattr(self.limits, name, limit)
        for name, (value, source) in memory["values"].items():
            self.channels[name].value, self.channels[name].source = tuple(value), source
        for name, (arrival_ns, answered) in memory["heard"].items():
            self.topics[name].arrival_ns, self.topics[name].answered = arrival_ns, answered

    def await_answers(self) -> None:
        """Count no message that has arrived as an answer."""
        for traffic in self.topics.values():
            traffic.answered = False

    def clear(self) -> None:
        """Discard all commands; the message counts are kept."""
        self.await_answers()
        for traffic in self.topics.values():
            traffic.arrival_ns = None
        for channel in self.channels.values():
            channel.value, channel.source = (), ""
