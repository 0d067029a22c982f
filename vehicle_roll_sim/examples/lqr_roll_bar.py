#!/usr/bin/env python3
"""Example controller: active roll bars with the gains of a linear-quadratic regulator.

Answers `motion` with `normal_force_cmd`. The law, M = -K x, is that of
vehicle_roll_sim.control_laws.roll_bar. Its gains are parameters: by default those for the reference
vehicle, and for another one `--ros-args --params-file` with the file that design_lqr_roll_bar.py
writes.
"""

from vehicle_roll_sim.controller import Controller, by_name, run  # isort: split

from vehicle_roll_sim.control_laws.gains_file import read_gains
from vehicle_roll_sim.control_laws.roll_bar import LqrRollBar


class LqrRollBarNode(Controller):
    node_name = "lqr_roll_bar"
    heard = ("motion",)
    said = ("normal_force_cmd",)

    def __init__(self):
        super().__init__()
        self.law = LqrRollBar(self.parameters(read_gains()))

    def answer(self, motion) -> tuple[float, ...]:
        return self.law.answer(by_name(motion))["normal_force"]


def main() -> None:
    run(LqrRollBarNode)


if __name__ == "__main__":
    main()
