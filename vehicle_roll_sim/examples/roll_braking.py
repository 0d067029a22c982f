#!/usr/bin/env python3
"""Example controller: brake the outer front wheel when a rollover is predicted.

Answers `rollover_prediction`, published by rollover_warning.py, with `brake_torque_cmd`. The law,
and its parameters, are those of vehicle_roll_sim.control_laws.roll_braking, which needs no ROS and
can also be used in studies, together with the prediction.
"""

from vehicle_roll_sim.controller import Controller, Topic, run  # isort: split

from vehicle_roll_sim.control_laws.roll_braking import Braking

RATIO, TIME_TO_ROLLOVER = 2, 3
"""Indices in `rollover_prediction`."""


class RollBraking(Controller):
    node_name = "roll_braking"
    heard = (Topic("rollover_prediction", "std_msgs/msg/Float64MultiArray"),)
    said = ("brake_torque_cmd",)

    def __init__(self):
        super().__init__()
        self.law = self.parameters_for(Braking)

    def answer(self, prediction) -> list[float]:
        return self.law.torques(prediction.data[RATIO], prediction.data[TIME_TO_ROLLOVER])


def main() -> None:
    run(RollBraking)


if __name__ == "__main__":
    main()
