#!/usr/bin/env python3
"""A controller to start from: brake the outer front wheel when a rollover is foreseen.

Answers `rollover_prediction`, which rollover_warning.py gives, with `brake_torque_cmd`. The brake
comes on with the predicted load transfer ratio beyond a threshold, and fully when the inner wheels
would lift within `full_braking_time`. The braked tire has less side force left, its drag turns the
vehicle out of the bend, and the speed falls: all three make the lateral acceleration less.
"""

from vehicle_roll_sim.controller import Controller, Topic, run

LF, RF = 0, 1
RATIO, TIME_TO_ROLLOVER = 2, 3
"""Places in `rollover_prediction`."""


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
