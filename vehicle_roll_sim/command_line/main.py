"""The command `vehicle_roll_sim` and its subcommands."""

import argparse
import sys

from vehicle_roll_sim.arguments import OneLineParser, exit_status
from vehicle_roll_sim.command_line import (
    compile,
    ending,
    linearize,
    paper,
    parameters,
    plot,
    replay,
    run,
    series,
    template,
)
from vehicle_roll_sim.command_line.ending import PROGRAM
from vehicle_roll_sim.declaration import unknown_name
from vehicle_roll_sim.vehicle.plausibility import unwarned
from vehicle_roll_sim.version import __version__

COMMANDS = {
    "run": (run.run_command, run.DESCRIPTION),
    "replay": (replay.replay_command, replay.DESCRIPTION),
    "series": (series.series_command, series.DESCRIPTION),
    "plot": (plot.plot_command, plot.DESCRIPTION),
    "linearize": (linearize.linearize_command, linearize.DESCRIPTION),
    "paper": (paper.paper_command, paper.DESCRIPTION),
    "compile": (compile.compile_command, compile.DESCRIPTION),
    "parameters": (parameters.parameters_command, parameters.DESCRIPTION),
    "template": (template.template_command, template.DESCRIPTION),
}


def main(words: list[str] | None = None) -> int:
    """Run the command with `words` (default: `sys.argv[1:]`); return the exit status."""
    if words is not None:
        return exit_status(lambda: _command(words), PROGRAM)

    def command() -> int:
        with ending.by_exceptions():
            return _command(sys.argv[1:])

    return exit_status(command, PROGRAM)


def _command(words: list[str]) -> int:
    with unwarned():  # commands print plausibility warnings themselves
        return _dispatch(words)


def _dispatch(words: list[str]) -> int:
    table = "\n".join(f"  {name:12}{about}" for name, (_, about) in COMMANDS.items())
    parser = OneLineParser(
        prog=PROGRAM,
        usage=f"{PROGRAM} COMMAND [options]",
        description="Simulate vehicle roll dynamics offline, without a running node.",
        epilog=f"commands (each has its own --help):\n{table}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"{PROGRAM} {__version__}")
    parser.add_argument("command", metavar="COMMAND")
    command = parser.parse_args(words[:1]).command
    if command not in COMMANDS:
        raise unknown_name(command, COMMANDS, "COMMAND")
    function, _ = COMMANDS[command]
    return function(words[1:], f"{PROGRAM} {command}")
