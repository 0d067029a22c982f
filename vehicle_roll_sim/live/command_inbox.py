"""External commands: checked on arrival, read once per period, discarded after a timeout."""

import dataclasses
import math
from collections.abc import Sequence

from vehicle_roll_sim.live.command_limits import CommandLimits
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.simulation.command import STILL_AIR, Command

HOLD, CENTRE = "hold", "centre"
SPEED, DRIVE, BRAKE = TOTALS = ("speed", "drive_torque", "brake")
"""Channels that are no fields of a Command: a speed for the speed controller, and total torques,
which the driveline and the brake system distribute."""
WIND = "wind"
"""The channel of the air's velocity over the ground."""
HEIGHT, FRICTION = OF_ROAD = ("road_height", "road_friction")
"""The channels of the road under the wheels."""
OVERRULED_BY = {
    "speed_cmd": ("wheel_torque_cmd", "drive_torque_cmd"),
    "drive_torque_cmd": ("wheel_torque_cmd",),
    "brake_cmd": ("brake_torque_cmd",),
}
"""The topics of these channels, and those that they give way to."""
DEFAULT_TIMEOUT = 0.5
"""s of simulated time"""
DROPPED, CLAMPED = "message dropped", "clamped"
"""How the text of a problem begins: what was done with the message."""


@dataclasses.dataclass
class Channel:
    """One command topic: its field, its number of values, and what has been received.

    limit: name of its limit in CommandLimits. smallest: lower bound of the values. value,
    arrival_ns: the last valid message and its simulated time of arrival (ns). received, dropped,
    clamped: message counts. answered: whether any message arrived since commands were last read.
    """

    field: str
    size: int
    limit: str
    smallest: float = -math.inf
    value: tuple[float, ...] = ()
    arrival_ns: int | None = None
    received: int = 0
    dropped: int = 0
    clamped: int = 0
    last_problem: str = ""
    answered: bool = False

    @property
    def is_steering(self) -> bool:
        return self.field in ("steering", "rear_steering")


def channels() -> dict[str, Channel]:
    """Every command topic, with nothing received yet."""
    return {
        "steering_cmd": Channel("steering", 1, "steering_limit"),
        "rear_steering_cmd": Channel("rear_steering", 1, "steering_limit"),
        "wheel_torque_cmd": Channel("wheel_torque", WHEEL_COUNT, "wheel_torque_limit"),
        "brake_torque_cmd": Channel("brake_torque", WHEEL_COUNT, "brake_torque_limit", 0.0),
        "normal_force_cmd": Channel("normal_force", WHEEL_COUNT, "normal_force_limit"),
        "speed_cmd": Channel(SPEED, 1, "speed_limit"),
        "drive_torque_cmd": Channel(DRIVE, 1, "drive_torque_limit"),
        "brake_cmd": Channel(BRAKE, 1, "brake_limit", 0.0),
        "wind_cmd": Channel(WIND, len(STILL_AIR), "wind_limit"),
        "road_height_cmd": Channel(HEIGHT, WHEEL_COUNT, "road_height_limit"),
        "road_friction_cmd": Channel(FRICTION, WHEEL_COUNT, "road_friction_limit", 0.0),
    }


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
        self._values, self._command = {}, Command()

    def receive(self, topic: str, values: Sequence[float], now_ns: int) -> str:
        """Store a message that arrived at simulated time `now_ns`; returns its problem, or ''."""
        channel = self.channels[topic]
        channel.received += 1
        channel.answered = True
        if flaw := _flaw(values, channel):
            channel.dropped += 1
            channel.last_problem = f"{DROPPED}: {flaw}"
            return channel.last_problem
        channel.value, channel.arrival_ns = tuple(values), now_ns
        if excess := self.limits.excess(channel.limit, values):
            channel.clamped += 1
            channel.last_problem = f"{CLAMPED}: {excess}"
            return channel.last_problem
        return ""

    def command(self, now_ns: int) -> Command:
        """The command for the period that begins at simulated time `now_ns`.

        Returns the same object as before if nothing has changed. Clears `answered` of all channels.
        """
        values = {}
        for channel in self.channels.values():
            channel.answered = False
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
        return [topic for topic in topics if not self.channels[topic].answered]

    def is_silent(self, channel: Channel, now_ns: int) -> bool:
        """Whether a topic has received a message before, but none within the timeout."""
        if channel.arrival_ns is None or self.timeout == 0.0:
            return False
        return now_ns - channel.arrival_ns > round(self.timeout * NANOSECONDS)

    def clear(self) -> None:
        """Discard all commands; the message counts are kept."""
        for channel in self.channels.values():
            channel.value, channel.arrival_ns, channel.answered = (), None, False


def _flaw(values: Sequence[float], channel: Channel) -> str:
    """The problem with the values of a message, or ''."""
    if len(values) != channel.size:
        return f"{len(values)} values, {channel.size} are expected"
    if not all(map(math.isfinite, values)):
        return f"{list(map(float, values))}: every value must be finite"
    if min(values) < channel.smallest:
        return f"{list(map(float, values))}: no value may be below {channel.smallest:g}"
    return ""
