"""The arguments of `score`, which are checked without ROS."""

import argparse

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.input_errors import number_within
from vehicle_roll_sim.scoring.catalogue import TESTS
from vehicle_roll_sim.scoring.spread import SPREAD

WARNING = "rollover_warning"
"""Topic (Bool) on which a controller may warn."""
DESCRIPTION = (
    "Score controllers: drive each in lockstep through a catalogue of tests over a spread of "
    "vehicles, compare it with the vehicle alone, and write a report."
)
DEFAULT_FOLDER, DEFAULT_PATIENCE = "score", 60.0
LEAST_PATIENCE, MOST_PATIENCE = 1.0, 3600.0
"""s"""
ANSWERS = (
    *("steering_cmd", "rear_steering_cmd", "wheel_torque_cmd", "brake_torque_cmd"),
    *("normal_force_cmd", "brake_cmd", WARNING),
)
"""Topics on which a controller may answer: what it commands, beside the driver, and its warning."""


def parser_of(program: str) -> argparse.ArgumentParser:
    """The parser of the arguments, for a program of that name."""
    tests = "\n".join(f"  {name:20}{test.title}" for name, test in TESTS.items())
    variants = "\n".join(f"  {name:20}{each.title}" for name, each in SPREAD.items())
    parser = OneLineParser(
        prog=program,
        description=DESCRIPTION,
        epilog=f"tests:\n{tests}\n\nvariants of the vehicle:\n{variants}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "controllers",
        metavar="CONTROLLER",
        nargs="+",
        help="an example, a script, a launch file, or a command line in quotation marks; parts of "
        "a chain are separated by ' + '",
    )
    parser.add_argument("--quick", action="store_true", help="fewer levels, variants and sides")
    parser.add_argument("--only", metavar="TEST", nargs="+", help="tests to drive (default: all)")
    parser.add_argument(
        "--out",
        metavar="DIR",
        default=DEFAULT_FOLDER,
        help="folder for the report; an interrupted score goes on in its folder "
        "(default: %(default)s)",
    )
    group = parser.add_argument_group("nodes")
    given = {"metavar": "NAME:=VALUE", "action": "append", "default": []}
    about = "set a parameter of the simulator, such as vehicle_file:=car.yaml; repeatable"
    group.add_argument("--simulator", **given, help=about)
    group.add_argument("--parameter", **given, help="set a parameter of the scripts; repeatable")
    group.add_argument(
        "--answers",
        metavar="TOPIC",
        nargs="+",
        help="topics on which a controller answers each set, for those that are not scripts: "
        + ", ".join(ANSWERS),
    )
    group.add_argument(
        "--restart", action="store_true", help="start the controller again for every run"
    )
    group.add_argument(
        "--patience",
        metavar="S",
        default=f"{DEFAULT_PATIENCE:g}",
        help="wall time to wait for a controller (default: %(default)s)",
    )
    about = "ROS domain ID to use (default: one that nobody else uses)"
    group.add_argument("--domain", metavar="N", help=about)
    return parser


def patience_of(text: str) -> float:
    """The wall time (s) to wait for a controller; raises InputError."""
    return number_within(text, "--patience", LEAST_PATIENCE, MOST_PATIENCE, "s")
