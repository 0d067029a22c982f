"""Implausible input: a warning on stderr, or an error with --strict."""

import argparse
import sys

from vehicle_roll_sim.command_line.signals import PROGRAM
from vehicle_roll_sim.declaration import InputError

OPTION = "--strict"


def add_strict(group: argparse._ArgumentGroup) -> None:
    """Add the option, unless the command already has a --strict with a different meaning."""
    if OPTION not in group._option_string_actions:
        about = "refuse implausible values (exit status 2) instead of printing a warning"
        group.add_argument(OPTION, dest="refuse_warnings", action="store_true", help=about)


def warn_or_refuse(doubts: list[str], arguments: argparse.Namespace) -> None:
    """Print one warning line per doubt; with --strict, raise InputError with all of them."""
    if doubts and getattr(arguments, "refuse_warnings", False):
        raise InputError(OPTION, "", "; ".join(doubts), "not plausible")
    for doubt in doubts:
        print(f"{PROGRAM}: warning: {doubt}", file=sys.stderr)
