"""What can be commanded from outside: a channel for each quantity, with its topic and traffic."""

import dataclasses
import math
from collections.abc import Sequence

from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.simulation.command import STILL_AIR

SPEED, DRIVE, BRAKE = TOTALS = ("speed", "drive_torque", "brake")
"""Channels that are no fields of a Command: a speed for the speed controller, and total torques,
which the driveline and the brake system distribute."""
WIND = "wind"
"""The channel of the air's velocity over the ground."""
HEIGHT, FRICTION = OF_ROAD = ("road_height", "road_friction")
"""The channels of the road under the wheels."""
DROPPED, CLAMPED = "message dropped", "clamped"
"""How the text of a problem begins: what was done with the message."""


@dataclasses.dataclass(kw_only=True)
class Traffic:
    """What has been received on one topic.

    arrival_ns: simulated time of arrival of the last valid message (ns). received, dropped,
    clamped: message counts. answered: whether any message arrived since commands were last read.
    """

    arrival_ns: int | None = None
    received: int = 0
    dropped: int = 0
    clamped: int = 0
    last_problem: str = ""
    answered: bool = False

    def note(self, kind: str, problem: str) -> str:
        """Count a problem, DROPPED or CLAMPED; returns its text."""
        if kind == DROPPED:
            self.dropped += 1
        else:
            self.clamped += 1
        self.last_problem = f"{kind}: {problem}"
        return self.last_problem


@dataclasses.dataclass
class Channel(Traffic):
    """One quantity that is commanded, and its topic: its field, its number of values, the last one.

    limit: name of its limit in CommandLimits. smallest: lower bound of the values. value: that of
    the last valid message, on its own topic or on another way in. source: the topic of that
    message. arrival_ns is that of this message, too; the counts are those of its own topic.
    """

    field: str
    size: int
    limit: str
    smallest: float = -math.inf
    value: tuple[float, ...] = ()
    source: str = ""

    @property
    def is_steering(self) -> bool:
        return self.field in ("steering", "rear_steering")

    def flaw(self, values: Sequence[float]) -> str:
        """The problem with the values of a message, or ''."""
        if len(values) != self.size:
            return f"{len(values)} values, {self.size} are expected"
        if not all(map(math.isfinite, values)):
            return f"{list(map(float, values))}: every value must be finite"
        if min(values) < self.smallest:
            return f"{list(map(float, values))}: no value may be below {self.smallest:g}"
        return ""


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
