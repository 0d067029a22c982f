"""The entry point of the command: installs signal handlers before any large import."""

import importlib

from vehicle_roll_sim.command_line import ending


def main() -> int:
    """Run the command with the arguments of the process; return the exit status."""
    with ending.whole_process():
        return importlib.import_module("vehicle_roll_sim.command_line.main").main()
