"""How the simulator runs: its own parameters, beside those of the model, road and vehicle."""

import dataclasses
import math

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.simulation.command_inbox import CENTRE, DEFAULT_TIMEOUT, HOLD
from vehicle_roll_sim.simulation.simulation import (
    DEFAULT_ROLLOVER_ANGLE,
    DEFAULT_SPEED,
    DEFAULT_STEP,
    LONGEST_STEP,
    MAXIMUM_SPEED,
    SHORTEST_STEP,
)
from vehicle_roll_sim.simulation.speed_controller import DEFAULT_BRAKE_LIMIT, DEFAULT_DRIVE_LIMIT


@dataclasses.dataclass
class Settings:
    """How the simulator runs; the options of the model, the road and the vehicle come beside it."""

    publish_rate: float = parameter("sets published a second", "Hz", 0.1, 10_000.0, default=100.0)
    step: float = parameter(
        "integration step", "s", SHORTEST_STEP, LONGEST_STEP, default=DEFAULT_STEP
    )
    initial_speed: float = parameter(
        "forward speed after a reset",
        "m/s",
        0.0,
        MAXIMUM_SPEED,
        tunable=True,
        default=DEFAULT_SPEED,
    )
    rollover_angle: float = parameter(
        "roll angle at which the integration stops",
        "rad",
        0.01,
        math.pi / 2,
        default=DEFAULT_ROLLOVER_ANGLE,
    )
    command_timeout: float = parameter(
        "simulated time without a message after which a command is given up, 0: never",
        "s",
        0.0,
        3600.0,
        tunable=True,
        default=DEFAULT_TIMEOUT,
    )
    steering_timeout_policy: str = parameter(
        "what a given-up steering command does", choices=(HOLD, CENTRE), tunable=True, default=HOLD
    )
    speed_drive_limit: float = parameter(
        "largest torque of each wheel's drive that speed_cmd may use",
        "N m",
        0.0,
        1e5,
        default=DEFAULT_DRIVE_LIMIT,
    )
    speed_brake_limit: float = parameter(
        "largest torque of each wheel's brake that speed_cmd may use",
        "N m",
        0.0,
        1e5,
        default=DEFAULT_BRAKE_LIMIT,
    )
    publish_clock: bool = parameter(
        "publish /clock, and stamp messages with simulated time from 0", default=False
    )
    frame_prefix: str = parameter("put before the frames in all messages", default="")
    vehicle_file: str = parameter("vehicle file (YAML); empty: the reference vehicle", default="")
