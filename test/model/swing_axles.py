"""Swing axles: wheels on arms that turn about pivots, whose roll centres move a lot."""

import dataclasses

import numpy as np

from vehicle_roll_sim import LF, LR, Vehicle

FIRST_WHEELS = {"front": LF, "rear": LR}
PIVOTS = {"front": (0.15, -0.50), "rear": (0.15, -0.47)}
"""Of the left wheels: to the left of the sprung c.g. and above it (m)."""
LARGEST_TURN = 0.28
"""rad"""


def arm(vehicle: Vehicle, axle: str) -> tuple[float, float]:
    """From the pivot of a left wheel to its centre at rest: to the left and up (m)."""
    left, up = PIVOTS[axle]
    wheel = FIRST_WHEELS[axle]
    height = float(vehicle.static_wheel_height[wheel]) - vehicle.cg_height
    return getattr(vehicle, f"{axle}_track") / 2 - left, height - up


def arm_tables(vehicle: Vehicle, axle: str, points: int = 63, shape=np.linspace) -> dict:
    """Half-track change and camber change of an axle on such arms, as a vehicle file has them."""
    left, up = arm(vehicle, axle)
    turn = shape(-LARGEST_TURN, LARGEST_TURN, points)
    travel = left * np.sin(turn) + up * np.cos(turn) - up
    radius = float(vehicle.static_loaded_radius[FIRST_WHEELS[axle]])
    outwards = left * np.cos(turn) - up * np.sin(turn) - left + radius * np.sin(turn)
    return {
        f"{axle}_half_track_change": tuple(zip(travel, outwards, strict=True)),
        f"{axle}_camber_change": tuple(zip(travel, -turn, strict=True)),
    }


def on_swing_axles(vehicle: Vehicle) -> Vehicle:
    return vehicle.with_values(arm_tables(vehicle, "front") | arm_tables(vehicle, "rear"))


def with_lateral_force_alone(vehicle: Vehicle) -> Vehicle:
    """On a tire that rolls freely and whose side force does not depend on the slip ratio."""
    tire = vehicle.tire.with_coefficients(LMUX=1e-9, RBY1=0.0)
    return dataclasses.replace(vehicle, tire=tire)
