"""Limits of external commands: largest values, and steering rate."""

import dataclasses
import math
from collections.abc import Sequence

from vehicle_roll_sim.declaration import parameter, parameters_of
from vehicle_roll_sim.simulation.command import Command
from vehicle_roll_sim.simulation.limits import MAXIMUM_SPEED
from vehicle_roll_sim.vehicle.plausibility import LARGEST_STEERING

LARGEST_LIMIT = 1e6
"""N or N m."""


@dataclasses.dataclass
class CommandLimits:
    """Commands beyond a limit are clamped to it, whatever their sign.

    The default force limit is slightly above the static load of a wheel; larger active forces could
    throw the vehicle over end to end, which the models do not cover. The default torque limits are
    several times what the tires can transmit.
    """

    steering_limit: float = parameter(
        "steering commands, front and rear, are clamped to this road-wheel angle",
        "rad",
        0.0,
        math.pi / 2,
        tunable=True,
        default=LARGEST_STEERING,
    )
    steering_rate_limit: float = parameter(
        "largest rate of the road-wheel angles, front and rear; 0: no limit",
        "rad/s",
        0.0,
        1000.0,
        tunable=True,
        default=0.0,
    )
    wheel_torque_limit: float = parameter(
        "values of wheel_torque_cmd are clamped to this torque at each wheel",
        "N m",
        0.0,
        LARGEST_LIMIT,
        tunable=True,
        default=5_000.0,
    )
    brake_torque_limit: float = parameter(
        "values of brake_torque_cmd are clamped to this torque at each wheel",
        "N m",
        0.0,
        LARGEST_LIMIT,
        tunable=True,
        default=10_000.0,
    )
    normal_force_limit: float = parameter(
        "values of normal_force_cmd are clamped to this force at each corner",
        "N",
        0.0,
        LARGEST_LIMIT,
        tunable=True,
        default=5_000.0,
    )
    speed_limit: float = parameter(
        "speed_cmd is clamped to this speed, forwards and backwards",
        "m/s",
        0.0,
        MAXIMUM_SPEED,
        tunable=True,
        default=MAXIMUM_SPEED,
    )

    drive_torque_limit: float = parameter(
        "drive_torque_cmd is clamped to this total torque",
        "N m",
        0.0,
        LARGEST_LIMIT,
        tunable=True,
        default=20_000.0,
    )
    brake_limit: float = parameter(
        "brake_cmd is clamped to this total torque",
        "N m",
        0.0,
        LARGEST_LIMIT,
        tunable=True,
        default=40_000.0,
    )
    wind_limit: float = parameter(
        "both components of wind_cmd are clamped to this speed",
        "m/s",
        0.0,
        MAXIMUM_SPEED,
        tunable=True,
        default=MAXIMUM_SPEED,
    )

    road_height_limit: float = parameter(
        "values of road_height_cmd are clamped to this height",
        "m",
        0.0,
        100.0,
        tunable=True,
        default=1.0,
    )
    road_friction_limit: float = parameter(
        "values of road_friction_cmd are clamped to this factor",
        "",
        0.0,
        10.0,
        tunable=True,
        default=10.0,
    )

    def clamped(self, name: str, values: tuple[float, ...]) -> tuple[float, ...]:
        """`values` clamped to the limit of that name, of either sign."""
        limit = getattr(self, name)
        if -limit <= min(values) and max(values) <= limit:
            return values
        return tuple(max(-limit, min(limit, value)) for value in values)

    def excess(self, name: str, values: Sequence[float]) -> str:
        """A text naming the value that exceeds the limit of that name; '' if none does."""
        limit = getattr(self, name)
        largest = max(values, key=abs)
        if abs(largest) <= limit:
            return ""
        return f"{float(largest):g} is beyond {name}, {limit:g} {UNITS[name]}".rstrip()

    def steered(self, before: Command, wanted: Command, period: float) -> Command:
        """`wanted` with rate-limited steering: what is reached from `before` in `period` (s)."""
        if self.steering_rate_limit == 0.0:
            return wanted
        most = self.steering_rate_limit * period
        front = _towards(before.steering, wanted.steering, most)
        rear = _towards(before.rear_steering, wanted.rear_steering, most)
        if (front, rear) == (wanted.steering, wanted.rear_steering):
            return wanted
        return dataclasses.replace(wanted, steering=front, rear_steering=rear)


def _towards(before: float, wanted: float, most: float) -> float:
    if abs(wanted - before) <= most:
        return wanted
    return before + most if wanted > before else before - most


UNITS = {name: declared.unit for name, declared in parameters_of(CommandLimits).items()}
