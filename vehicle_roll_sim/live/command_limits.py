"""How much of a command from outside is driven: the largest values, the fastest steering."""

import dataclasses
import math
from collections.abc import Sequence

from vehicle_roll_sim.declaration import parameter, parameters_of
from vehicle_roll_sim.simulation.command import Command
from vehicle_roll_sim.simulation.simulation import MAXIMUM_SPEED
from vehicle_roll_sim.vehicle.plausibility import LARGEST_STEERING

LARGEST_LIMIT = 1e6
"""N or N m."""


@dataclasses.dataclass
class CommandLimits:
    """What is beyond them is driven as the limit itself, of either sign.

    The default forces are a little above the static load of a wheel: with more the vehicle can be
    thrown head over heels, which the models do not have. The default torques are several times what
    tires can pass on to the road.
    """

    steering_limit: float = parameter(
        "largest steering angle that is taken, front and rear",
        "rad",
        0.0,
        math.pi / 2,
        tunable=True,
        default=LARGEST_STEERING,
    )
    steering_rate_limit: float = parameter(
        "fastest change of a steering angle, front and rear, 0: any",
        "rad/s",
        0.0,
        1000.0,
        tunable=True,
        default=0.0,
    )
    wheel_torque_limit: float = parameter(
        "largest torque of wheel_torque_cmd that is taken, at each wheel",
        "N m",
        0.0,
        LARGEST_LIMIT,
        tunable=True,
        default=5_000.0,
    )
    brake_torque_limit: float = parameter(
        "largest torque of brake_torque_cmd that is taken, at each wheel",
        "N m",
        0.0,
        LARGEST_LIMIT,
        tunable=True,
        default=10_000.0,
    )
    normal_force_limit: float = parameter(
        "largest force of normal_force_cmd that is taken, at each corner",
        "N",
        0.0,
        LARGEST_LIMIT,
        tunable=True,
        default=5_000.0,
    )
    speed_limit: float = parameter(
        "largest speed of speed_cmd that is taken, ahead or back",
        "m/s",
        0.0,
        MAXIMUM_SPEED,
        tunable=True,
        default=MAXIMUM_SPEED,
    )

    def clamped(self, name: str, values: tuple[float, ...]) -> tuple[float, ...]:
        """`values` within the limit of that name."""
        limit = getattr(self, name)
        if -limit <= min(values) and max(values) <= limit:
            return values
        return tuple(max(-limit, min(limit, value)) for value in values)

    def excess(self, name: str, values: Sequence[float]) -> str:
        """Which value the limit of that name cuts, and to what; '' if none."""
        limit = getattr(self, name)
        largest = max(values, key=abs)
        if abs(largest) <= limit:
            return ""
        return f"{float(largest):g} is beyond {name}, {limit:g} {UNITS[name]}"

    def steered(self, before: Command, wanted: Command, period: float) -> Command:
        """`wanted` with the steering that can be reached from `before` within `period` (s)."""
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
