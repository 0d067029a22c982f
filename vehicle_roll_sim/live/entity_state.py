"""Pose, velocity and acceleration of the vehicle in the ground frame, and setting them."""

import dataclasses
import math
from collections.abc import Sequence

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.model.frames import (
    attitude_of,
    body_to_yawed,
    heading_of,
    quaternion,
    yawed_to_ground,
)
from vehicle_roll_sim.simulation.simulation import Simulation

NEAR = 1e-6
"""Largest difference (m, rad, m/s, rad/s) at which a value counts as the one that is allowed."""
UNIT = 1e-3
"""Largest difference of the norm of a quaternion from 1."""


@dataclasses.dataclass(frozen=True)
class EntityState:
    """Position (m) and orientation (x, y, z, w) of the body, and vectors along the ground frame.

    velocity (m/s), turning (rad/s), acceleration (m/s^2): of the c.g. nan where a model has none.
    """

    position: tuple[float, ...]
    orientation: tuple[float, ...]
    velocity: tuple[float, ...]
    turning: tuple[float, ...]
    acceleration: tuple[float, ...]


def entity_state(simulation: Simulation) -> EntityState:
    """The present state of the vehicle; what the 8 DOF model does not have counts as 0."""
    roll, pitch, yaw = angles = _angles(simulation)
    axes = angles
    x, y, z, *body = simulation.cg_motion
    if simulation.options.has_eight_dof:  # no vertical velocity: v is its level one times cos(roll)
        axes, body[1] = (0.0, 0.0, yaw), body[1] / math.cos(roll)
    rates = (simulation.state[name] for name in ("roll_rate", "pitch_rate", "yaw_rate"))
    forward, left, up = simulation.outputs["acceleration"].tolist()
    return EntityState(
        (x, y, _or_zero(z)),
        quaternion(roll, pitch, yaw),
        _to_ground(axes, body),
        _to_ground(axes, rates),
        tuple(map(float, (*yawed_to_ground(heading_of(yaw), forward, left), _or_zero(up)))),
    )


def _angles(simulation: Simulation) -> tuple[float, float, float]:
    return tuple(_or_zero(simulation.state[name]) for name in ("roll", "pitch", "yaw"))


def _or_zero(value) -> float:
    return 0.0 if math.isnan(value) else float(value)


def _to_ground(angles: tuple[float, float, float], vector) -> tuple[float, ...]:
    """A vector in the body frame along the ground frame."""
    roll, pitch, yaw = angles
    ahead, left, up = body_to_yawed(attitude_of(roll, pitch), *map(_or_zero, vector))
    return (*yawed_to_ground(heading_of(yaw), ahead, left), up)


def put(session: Session, position: Sequence[float], orientation: Sequence[float]) -> None:
    """Put the vehicle at a pose on the road: only x, y and yaw can be chosen.

    Height, roll and pitch are those that the suspension has; give them as they are, or as 0. Raises
    InputError for any other pose.
    """
    numbers = (*position, *orientation)
    norm = math.hypot(*orientation)
    if not all(map(math.isfinite, numbers)) or abs(norm - 1.0) > UNIT:
        raise InputError("pose", numbers, "finite numbers and a quaternion of norm 1")
    roll, pitch, yaw = _euler(*(each / norm for each in orientation))
    present = _angles(session.simulation)
    height = _or_zero(session.simulation.cg_motion[2])
    fixed = {"z": (position[2], height), "roll": (roll, present[0]), "pitch": (pitch, present[1])}
    for name, (wanted, now) in fixed.items():
        if min(abs(wanted), abs(wanted - now)) > NEAR:
            allowed = f"0 or {now:.6g}, as the suspension has it; only x, y and yaw can be set"
            raise InputError(name, wanted, allowed)
    session.simulation.place(position[0], position[1], yaw, session.applied)


def set_going(session: Session, velocity: Sequence[float], turning: Sequence[float]) -> None:
    """Let the vehicle roll freely in static equilibrium at a velocity along its heading.

    velocity, turning: along the ground frame (m/s, rad/s). Raises InputError for others.
    """
    if not all(map(math.isfinite, (*velocity, *turning))):
        raise InputError("twist", (*velocity, *turning), "finite numbers")
    sine, cosine = heading_of(_angles(session.simulation)[2])
    ahead = cosine * velocity[0] + sine * velocity[1]
    across = cosine * velocity[1] - sine * velocity[0]
    if max(map(abs, (across, velocity[2], *turning))) > NEAR:
        raise InputError("twist", (*velocity, *turning), "a velocity along the heading alone")
    session.set_going(ahead)


def _euler(x: float, y: float, z: float, w: float) -> tuple[float, float, float]:
    """Roll, pitch and yaw (rad) of a unit quaternion."""
    roll = math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2.0 * (w * y - z * x))))
    return roll, pitch, math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
