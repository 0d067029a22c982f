#!/usr/bin/env python3
"""Example controller: brake the outer front wheel when a rollover is predicted.

Answers `rollover_prediction`, published by rollover_warning.py, with `brake_torque_cmd`. The brake
torque grows with the predicted load transfer ratio above a threshold, and is largest when the inner
wheels are predicted to lift within `full_braking_time`. The braked tire can build up less lateral
force, its drag yaws the vehicle out of the turn, and the speed falls: all three reduce the lateral
acceleration.
"""

from vehicle_roll_sim.controller import Controller, Topic, run

LF, RF = 0, 1
RATIO, TIME_TO_ROLLOVER = 2, 3
"""Indices in `rollover_prediction`."""


class RollBraking(Controller):
    node_name = "roll_braking"
    heard = (Topic("rollover_prediction", "std_msgs/msg/Float64MultiArray"),)
    said = ("brake_torque_cmd",)

    def __init__(self):
        super().__init__()
        self.threshold = self.parameter("threshold", 0.8)  # predicted load transfer ratio
        self.gain = self.parameter("gain", 8000.0)  # N m per unit beyond it
        self.largest = self.parameter("largest_torque", 2000.0)  # N m
        self.full_braking_time = self.parameter("full_braking_time", 0.3)  # s

    def answer(self, prediction) -> list[float]:
        ratio = prediction.data[RATIO]
        torque = min(self.largest, max(0.0, self.gain * (abs(ratio) - self.threshold)))
        if prediction.data[TIME_TO_ROLLOVER] <= self.full_braking_time:
            torque = self.largest
        torques = [0.0] * 4
        torques[RF if ratio > 0.0 else LF] = torque
        return torques


def main() -> None:
    run(RollBraking)


if __name__ == "__main__":
    main()
