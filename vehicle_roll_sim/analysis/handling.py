"""How a vehicle behaves in gentle steady turns: understeer and roll gradient."""

from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.analysis.trim import STEERING, find_trim
from vehicle_roll_sim.model.records import ROLL, YAW_RATE
from vehicle_roll_sim.runs.metrics import roll_gradient, understeer_gradient
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

GENTLE = 1.0
"""m/s^2: lateral acceleration of the two turns, to the left and to the right."""


class Gradients(NamedTuple):
    """Slopes over lateral acceleration (rad/(m/s^2)), as ISO 4138 defines them.

    understeer: of the road-wheel angle less the Ackermann angle, wheelbase * yaw rate / speed.
    roll: of the roll angle.
    """

    understeer: float
    roll: float


def gradients_of(vehicle: Vehicle, options: Options | None = None, *, speed: float) -> Gradients:
    """The gradients between steady turns to both sides with GENTLE lateral acceleration.

    speed: forward speed (m/s). Raises InputError if there is no such turn.
    """
    wheelbase = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    turns = [
        find_trim(vehicle, options, speed=speed, lateral_acceleration=side * GENTLE)
        for side in (-1.0, 1.0)
    ]
    acceleration = np.array([trim.outputs.acceleration[1] for trim in turns])
    steering = np.array([trim.inputs[STEERING] for trim in turns])
    yaw_rate, roll = np.array([trim.state[[YAW_RATE, ROLL]] for trim in turns]).T
    understeer = understeer_gradient(acceleration, steering, yaw_rate, speed, wheelbase)
    return Gradients(float(understeer), float(roll_gradient(acceleration, roll)))
