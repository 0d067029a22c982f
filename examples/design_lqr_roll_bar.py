#!/usr/bin/env python3
"""Design the gains of the controller lqr_roll_bar for a vehicle: a ROS parameter file.

python3 design_lqr_roll_bar.py --vehicle car.yaml --speed 25 --output gains.yaml
ros2 run vehicle_roll_sim lqr_roll_bar --ros-args --params-file gains.yaml
"""

import argparse
import sys

from vehicle_roll_sim.arguments import (
    OneLineParser,
    add_declared,
    declared_values,
    exit_status,
    named_file,
)
from vehicle_roll_sim.command_line.vehicle_options import (
    add_vehicle_options,
    chosen_options,
    chosen_vehicle,
)
from vehicle_roll_sim.control_laws.gains_file import as_parameter_file
from vehicle_roll_sim.control_laws.roll_bar_design import RollBarCriteria, design
from vehicle_roll_sim.files.output_file import check_writable, replaced_file
from vehicle_roll_sim.simulation.options import Options


def design_gains(arguments: argparse.Namespace) -> int:
    file = named_file(arguments.output, "--output")
    if file:
        check_writable(file, "--output")
    vehicle = chosen_vehicle(arguments)
    criteria = RollBarCriteria(**declared_values(arguments, RollBarCriteria))
    designed = design(vehicle, chosen_options(arguments, vehicle), criteria)
    name = " ".join((arguments.vehicle or "reference", *arguments.set))
    text = as_parameter_file(designed, criteria, name)
    if file:
        with replaced_file(file) as partial:
            partial.write_text(text, encoding="utf-8")
    else:
        print(text, end="")
    return 0


def main() -> int:
    parser = OneLineParser(description=__doc__.partition("\n")[0])
    add_declared(parser, RollBarCriteria, "criteria")
    add_declared(parser, Options, "model")
    add_vehicle_options(parser)
    parser.add_argument("--output", metavar="FILE", help="write the gains here, not to the screen")
    return exit_status(lambda: design_gains(parser.parse_args()), parser.prog)


if __name__ == "__main__":
    sys.exit(main())
