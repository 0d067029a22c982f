#!/usr/bin/env python3
"""A warning to start from: load transfer and time to rollover, foreseen with a roll-plane model.

Answers `imu` with `rollover_prediction` (std_msgs/Float64MultiArray: time, load_transfer_ratio,
predicted_load_transfer_ratio, time_to_rollover), for controllers such as roll_braking.py, and with
`rollover_warning` (std_msgs/Bool). The model is in vehicle_roll_sim.analysis.rollover_prediction,
its vehicle that of the simulator's parameters.
"""

import math

from controller import QUEUED, Controller, run
from sensor_msgs.msg import Imu
from std_msgs.msg import Bool, Float64MultiArray

from vehicle_roll_sim.analysis.rollover_prediction import (
    Foresight,
    Prediction,
    RolloverPredictor,
)
from vehicle_roll_sim.ros.qos_overrides import make_publisher
from vehicle_roll_sim.ros.simulated_vehicle import simulated_vehicle
from vehicle_roll_sim.ros.simulator_client import SimulatorClient

FORESIGHT = ("horizon", "interval", "persistence", "smoothing")
"""Its numbers."""


class RolloverWarning(Controller):
    needs_listener = False

    def __init__(self):
        super().__init__(
            "rollover_warning", ("imu", Imu), ("rollover_prediction", Float64MultiArray)
        )
        self.simulator = self.declare_parameter("simulator", "simulator").value  # node's name
        self.warning_time = self.parameter("warning_time", 0.5)  # warn that long before, s
        self.foresight = Foresight(
            **{name: self.parameter(name, getattr(Foresight, name)) for name in FORESIGHT}
        )
        self.warning = make_publisher(self, Bool, "rollover_warning", QUEUED)
        self.warned = False

    def prepare(self) -> None:
        simulator = SimulatorClient(self, self.executor, self.simulator)
        vehicle, _ = simulated_vehicle(simulator.get)
        self.predictor = RolloverPredictor(vehicle, self.foresight)

    def answer(self, imu: Imu) -> list[float]:
        time = imu.header.stamp.sec + 1e-9 * imu.header.stamp.nanosec
        rates, specific = imu.angular_velocity, imu.linear_acceleration
        roll = roll_of(imu.orientation)
        lateral = math.cos(roll) * specific.y - math.sin(roll) * specific.z  # along the ground
        found = self.predictor.update(time, roll, rates.x, lateral)
        self.warn(time, found)
        return [
            time,
            found.load_transfer_ratio,
            found.predicted_load_transfer_ratio,
            found.time_to_rollover,
        ]

    def warn(self, time: float, found: Prediction) -> None:
        left = found.time_to_rollover
        is_near = left <= self.warning_time
        self.warning.publish(Bool(data=is_near))
        if is_near and not self.warned:
            side = "left" if found.predicted_load_transfer_ratio > 0.0 else "right"
            self.get_logger().warning(f"at {time:.2f} s: the {side} wheels lift in {left:.2f} s")
        self.warned = is_near


def roll_of(q) -> float:
    """Roll angle (rad) of an attitude as a quaternion."""
    return math.atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x**2 + q.y**2))


if __name__ == "__main__":
    run(RolloverWarning)
