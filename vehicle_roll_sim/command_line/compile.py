"""`vehicle_roll_sim compile`: compile the model before anybody waits for it."""

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.command_line import ending
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.model.compiled import jit


def compile_command(words: list[str], program: str) -> int:
    """The command, given the words behind its name; returns the exit status."""
    OneLineParser(prog=program, description=COMMANDS["compile"]).parse_args(words)
    with ending.at_once():
        compile_model()
    print(jit.describe())
    return 0
