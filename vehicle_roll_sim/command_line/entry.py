"""The entry point of the command: its signals are handled before anything large is imported."""

import importlib

from vehicle_roll_sim.command_line import ending


def main() -> int:
    """Run the command with the words of the process; returns the exit status."""
    with ending.whole_process():
        return importlib.import_module("vehicle_roll_sim.command_line.main").main()
