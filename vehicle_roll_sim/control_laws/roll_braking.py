"""Brake the outer front wheel when a rollover is predicted.

The brake torque grows with the predicted load transfer ratio above a threshold, and is largest when
the inner wheels are predicted to lift within `full_braking_time`. The braked tire can build up less
lateral force, its drag yaws the vehicle out of the turn, and the speed falls: all three reduce the
lateral acceleration.
"""

import dataclasses
import math

from vehicle_roll_sim.analysis.rollover_prediction import (
    Foresight,
    Prediction,
    RolloverPredictor,
)
from vehicle_roll_sim.declaration import parameter, parameters_of
from vehicle_roll_sim.model.records import LF, RF, WHEEL_COUNT
from vehicle_roll_sim.runs.control_law import ControlLaw, Sensed
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle


@dataclasses.dataclass(kw_only=True)
class Braking:
    """The brake torques that answer a prediction."""

    threshold: float = parameter("predicted load transfer ratio", "", 0.0, 10.0, default=0.8)
    gain: float = parameter(
        "brake torque per unit of the ratio beyond the threshold", "N m", 0.0, 1e6, default=8000.0
    )
    largest_torque: float = parameter("largest brake torque", "N m", 0.0, 1e6, default=2000.0)
    full_braking_time: float = parameter(
        "time to rollover at which the brake torque is largest", "s", 0.0, 10.0, default=0.3
    )

    def torques(self, ratio: float, time_to_rollover: float) -> list[float]:
        """Brake torque (N m) at lf, rf, lr, rr for a predicted load transfer ratio and a time."""
        torque = min(self.largest_torque, max(0.0, self.gain * (abs(ratio) - self.threshold)))
        if time_to_rollover <= self.full_braking_time:
            torque = self.largest_torque
        torques = [0.0] * WHEEL_COUNT
        torques[RF if ratio > 0.0 else LF] = torque
        return torques


@dataclasses.dataclass(kw_only=True)
class RollBraking(ControlLaw, Foresight, Braking):
    """The prediction of the load transfer, and the brake torques that answer it."""

    commands = ("brake_torque",)

    def begin(self, vehicle: Vehicle, options: Options) -> None:
        foresight = {name: getattr(self, name) for name in parameters_of(Foresight)}
        self._predictor = RolloverPredictor(vehicle, Foresight(**foresight))

    def answer(self, sensed: Sensed) -> dict:
        specific = [float(each) for each in sensed.outputs["specific_force"]]
        rate = float(sensed.state["roll_rate"])
        found = predicted(self._predictor, sensed.time, sensed.attitude, rate, specific)
        ratio, left = found.predicted_load_transfer_ratio, found.time_to_rollover
        return {"brake_torque": self.torques(ratio, left)}


def predicted(
    predictor: RolloverPredictor,
    time: float,
    attitude: tuple[float, float, float, float],
    roll_rate: float,
    specific: list[float],
) -> Prediction:
    """The prediction at a time (s) from what an inertial sensor at the c.g. measures.

    attitude: quaternion (x, y, z, w). roll_rate: rad/s. specific: specific force (m/s^2).
    """
    roll = roll_of(*attitude)
    lateral = math.cos(roll) * specific[1] - math.sin(roll) * specific[2]  # along the ground
    return predictor.update(time, roll, roll_rate, lateral)


def roll_of(x: float, y: float, z: float, w: float) -> float:
    """Roll angle (rad) of an attitude given as a quaternion."""
    return math.atan2(2 * (w * x + y * z), 1 - 2 * (x**2 + y**2))
