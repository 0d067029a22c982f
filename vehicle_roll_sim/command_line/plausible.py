"""What is not plausible of the input: warnings on stderr, or errors with --strict."""

import argparse
import sys

from vehicle_roll_sim.command_line.ending import PROGRAM
from vehicle_roll_sim.declaration import InputError

OPTION = "--strict"


def add_strict(group: argparse._ArgumentGroup) -> None:
    """The option, unless the command has one of that name with a meaning of its own."""
    if OPTION not in group._option_string_actions:
        about = "refuse what is not plausible with status 2, instead of a warning"
        group.add_argument(OPTION, dest="refuse_doubts", action="store_true", help=about)


def heed(doubts: list[str], arguments: argparse.Namespace) -> None:
    """Warn of each doubt in a line; with --strict raise InputError with all of them."""
    if doubts and getattr(arguments, "refuse_doubts", False):
        raise InputError(OPTION, "", "; ".join(doubts), "not plausible")
    for doubt in doubts:
        print(f"{PROGRAM}: warning: {doubt}", file=sys.stderr)
