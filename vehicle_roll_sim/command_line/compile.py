"""`vehicle_roll_sim compile`: compile the model ahead of time."""

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.model.compiled import jit


def compile_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    OneLineParser(prog=program, description=COMMANDS["compile"]).parse_args(words)
    with signals.exit_on_signal():
        compile_model()
    print(jit.describe())
    return 0
