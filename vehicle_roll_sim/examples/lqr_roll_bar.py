#!/usr/bin/env python3
"""Example controller: active roll bars with the gains of a linear-quadratic regulator.

Answers `motion` with `normal_force_cmd`. The law, M = -K x, is that of
vehicle_roll_sim.control_laws.lqr_roll_bar, which needs no ROS and can also be used in studies. Its
gains are parameters: by default those for the reference vehicle, and for another one `--ros-args
--params-file` with the file that design_lqr_roll_bar.py writes.
"""

from vehicle_roll_sim.controller import Controller, by_name, run  # isort: split

from vehicle_roll_sim.control_laws import lqr_roll_bar


class LqrRollBar(Controller):
    node_name = "lqr_roll_bar"
    heard = ("motion",)
    said = ("normal_force_cmd",)

    def __init__(self):
        super().__init__()
        self.law = self.parameters_for(lqr_roll_bar.LqrRollBar)

    def answer(self, motion) -> list[float]:
        return self.law.forces(by_name(motion))


def main() -> None:
    run(LqrRollBar)


if __name__ == "__main__":
    main()
