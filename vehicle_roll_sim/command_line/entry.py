"""The entry point of the command: installs signal handlers before any import."""

from vehicle_roll_sim import early_signals


def main() -> int:
    """Run the command with the arguments of the process; return the exit status."""
    early_signals.end_command_at_once()
    import importlib

    from vehicle_roll_sim.command_line import signals

    with signals.exit_on_signal_throughout():
        return importlib.import_module("vehicle_roll_sim.command_line.main").main()
