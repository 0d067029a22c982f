#!/usr/bin/env python3
"""Example warning: load transfer and time to rollover, predicted with a roll-plane model.

Answers `imu` with `rollover_prediction` (std_msgs/Float64MultiArray: time, load_transfer_ratio,
predicted_load_transfer_ratio, time_to_rollover), for controllers such as roll_braking.py, and with
`rollover_warning` (std_msgs/Bool). The model is vehicle_roll_sim.analysis.rollover_prediction; its
vehicle is read from the simulator's parameters.
"""

from vehicle_roll_sim.controller import Controller, Topic, run  # isort: split

from vehicle_roll_sim.analysis.rollover_prediction import (
    Foresight,
    Prediction,
    RolloverPredictor,
)
from vehicle_roll_sim.control_laws.roll_braking import predicted
from vehicle_roll_sim.ros.clients.simulated_vehicle import simulated_vehicle
from vehicle_roll_sim.ros.clients.simulator_client import SimulatorClient


class RolloverWarning(Controller):
    node_name = "rollover_warning"
    heard = ("imu",)
    said = (
        Topic("rollover_prediction", "std_msgs/msg/Float64MultiArray"),
        Topic("rollover_warning", "std_msgs/msg/Bool"),
    )
    needs_listener = False

    def __init__(self):
        super().__init__()
        self.simulator = self.declare_parameter("simulator", "simulator").value  # node name
        self.warning_time = self.parameter("warning_time", 0.5)  # time to rollover to warn at, s
        self.foresight = self.parameters_for(Foresight)
        self.warned = False

    def prepare(self) -> None:
        simulator = SimulatorClient(self, self.executor, self.simulator)
        vehicle, _ = simulated_vehicle(simulator.get)
        self.predictor = RolloverPredictor(vehicle, self.foresight)

    def answer(self, imu) -> dict:
        stamp = imu.header.stamp
        time = (stamp.sec * 1_000_000_000 + stamp.nanosec) / 1e9  # s, rounded like simulated time
        attitude, specific = imu.orientation, imu.linear_acceleration
        found = predicted(
            self.predictor,
            time,
            (attitude.x, attitude.y, attitude.z, attitude.w),
            imu.angular_velocity.x,
            [specific.x, specific.y, specific.z],
        )
        prediction = [
            time,
            found.load_transfer_ratio,
            found.predicted_load_transfer_ratio,
            found.time_to_rollover,
        ]
        warning = self.warns(time, found)
        return {"rollover_prediction": prediction, "rollover_warning": warning}

    def warns(self, time: float, found: Prediction) -> bool:
        left = found.time_to_rollover
        is_near = left <= self.warning_time
        if is_near and not self.warned:
            side = "left" if found.predicted_load_transfer_ratio > 0.0 else "right"
            self.get_logger().warning(f"at {time:.2f} s: the {side} wheels lift in {left:.2f} s")
        self.warned = is_near
        return is_near


def main() -> None:
    run(RolloverWarning)


if __name__ == "__main__":
    main()
