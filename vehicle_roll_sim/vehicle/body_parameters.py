"""Parameters of the body: the box that touches the ground and is drawn."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.model.records import BODY

FRONT_OVERHANG, REAR_OVERHANG, LONGEST_OVERHANG = 0.8, 0.9, 0.4
"""m, of a passenger car; and at most this share of the wheelbase."""
TIRE_WIDTH, WIDEST_TIRE = 0.205, 0.2
"""m: width of the reference tire, 205/60R15, which vehicle files do not specify; and at most this
share of the track."""
ROOF, FLOOR, CLEARANCE = 2.5, 0.5, 0.25
"""Heights of roof and floor over that of the sprung c.g., and the greatest height of the floor
(m)."""
SINKAGE = 0.01
"""Share of its height by which the body sinks in when it lies on four corners."""
DAMPING_RATIO = 0.5
"""Of the bounce on four corners."""
FRICTION = 0.5
"""Painted steel on asphalt slides with some 0.3 to 0.6."""
_LENGTH = {"unit": "m", "minimum": 0.0, "maximum": 50.0}


@dataclasses.dataclass(frozen=True)
class BodyBox:
    """The body as a box with springs and dampers at its corners (option `body_contact`)."""

    body_front_overhang: float | None = parameter(
        f"length of the body ahead of the front axle; by default {FRONT_OVERHANG:g}, but at most "
        f"{LONGEST_OVERHANG:g} of the wheelbase",
        **_LENGTH,
        default=None,
    )
    body_rear_overhang: float | None = parameter(
        f"length of the body behind the rear axle; by default {REAR_OVERHANG:g}, but at most "
        f"{LONGEST_OVERHANG:g} of the wheelbase",
        **_LENGTH,
        default=None,
    )
    body_width: float | None = parameter(
        f"width of the body; by default the larger track plus {TIRE_WIDTH:g}, but at most "
        f"{1 + WIDEST_TIRE:g} times the track",
        "m",
        0.01,
        50.0,
        default=None,
    )
    body_roof_height: float | None = parameter(
        f"height of the roof above ground at rest; by default {ROOF:g} times that of the sprung "
        "c.g.",
        **_LENGTH,
        default=None,
    )
    body_floor_height: float | None = parameter(
        f"height of the floor above ground at rest; by default {CLEARANCE:g}, but at most "
        f"{FLOOR:g} of that of the sprung c.g.",
        **_LENGTH,
        default=None,
    )
    body_stiffness: float | None = parameter(
        "stiffness of a corner of the body in the ground; by default the body, lying on "
        f"four corners, sinks in by {SINKAGE:.0%} of its height",
        "N/m",
        1e-3,
        1e10,
        default=None,
    )
    body_damping: float | None = parameter(
        "damping of a corner of the body in the ground; by default the damping ratio of "
        f"the bounce on four corners is {DAMPING_RATIO:g}",
        "N s/m",
        0.0,
        1e9,
        default=None,
    )
    body_friction: float | None = parameter(
        f"coefficient of friction between body and ground; by default {FRICTION:g}",
        "",
        0.0,
        10.0,
        default=None,
    )


def body_heights(vehicle) -> tuple[float, float]:
    """Heights of floor and roof above ground at rest (m)."""
    lowest = min(CLEARANCE, FLOOR * vehicle.cg_height)
    floor = _given(vehicle.body_floor_height, lowest)
    return floor, _given(vehicle.body_roof_height, ROOF * vehicle.cg_height)


def body_of(vehicle, gravity: float) -> np.ndarray:
    """One BODY record, shape (1,); gravity: m/s^2."""
    base, track = vehicle.wheelbase, max(vehicle.front_track, vehicle.rear_track)
    longest, offset = LONGEST_OVERHANG * base, vehicle.cg_offset or 0.0
    width = _given(vehicle.body_width, track + min(TIRE_WIDTH, WIDEST_TIRE * track))
    ahead = _given(vehicle.body_front_overhang, min(FRONT_OVERHANG, longest))
    behind = _given(vehicle.body_rear_overhang, min(REAR_OVERHANG, longest))
    floor, roof = body_heights(vehicle)
    corners = 4
    sinkage = SINKAGE * (roof - floor)
    stiffness = _given(vehicle.body_stiffness, vehicle.mass * gravity / corners / sinkage)
    critical = 2 * math.sqrt(stiffness * vehicle.mass / corners)
    record = np.zeros(1, BODY)
    record[0] = (
        vehicle.cg_to_front_axle + ahead,
        vehicle.cg_to_rear_axle + behind,
        width / 2 - offset,
        width / 2 + offset,
        roof - vehicle.cg_height,
        vehicle.cg_height - floor,
        stiffness,
        _given(vehicle.body_damping, DAMPING_RATIO * critical),
        _given(vehicle.body_friction, FRICTION),
    )
    return record


def check_body(vehicle) -> None:
    """Raise InputError unless the roof is above the floor."""
    floor, roof = body_heights(vehicle)
    if not roof > floor:
        name = next(n for n in ("body_roof_height", "body_floor_height") if n in vehicle.given)
        allowed = f"more than the height of the floor, {floor:g} m"
        if name == "body_floor_height":
            allowed = f"less than the height of the roof, {roof:g} m"
        raise InputError(name, vehicle.given[name], allowed)


def _given(value: float | None, default: float) -> float:
    return default if value is None else value
