"""The command `vehicle_roll_sim` and its subcommands."""

import argparse
import contextlib
import importlib
import sys
from collections.abc import Callable

from vehicle_roll_sim.arguments import OneLineParser, exit_status
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.signals import PROGRAM
from vehicle_roll_sim.declaration import unknown_name


def main(words: list[str] | None = None) -> int:
    """Run the command with `words` (default: `sys.argv[1:]`); return the exit status."""

    def command() -> int:
        given = sys.argv[1:] if words is None else words
        if words is None and _is_for_help(given):
            sys.modules.setdefault("numba", None)  # its import takes longer than all others
        name, function = _chosen(given[:1])
        from vehicle_roll_sim.vehicle.plausibility import unwarned  # with what it has imported

        interrupted = signals.raise_on_signal() if words is None else contextlib.nullcontext()
        with interrupted, unwarned():  # commands print plausibility warnings themselves
            return function(given[1:], f"{PROGRAM} {name}")

    return exit_status(command, PROGRAM)


def _is_for_help(words: list[str]) -> bool:
    """Whether `words` can end only with a help text, or with an error."""
    options = words[: words.index("--")] if "--" in words else words
    return bool({"-h", "--help"} & {*options})


def _chosen(words: list[str]) -> tuple[str, Callable[[list[str], str], int]]:
    """The name of the subcommand among `words` and its function, imported."""
    table = "\n".join(f"  {name:12}{about}" for name, about in COMMANDS.items())
    parser = OneLineParser(
        prog=PROGRAM,
        usage=f"{PROGRAM} COMMAND [options]",
        description="Simulate vehicle roll dynamics offline, without a running node.",
        epilog=f"commands (each has its own --help):\n{table}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action=_ShowVersion, nargs=0, help=_ShowVersion.__doc__)
    parser.add_argument("command", metavar="COMMAND")
    name = parser.parse_args(words).command
    if name not in COMMANDS:
        raise unknown_name(name, COMMANDS, "COMMAND")
    module = importlib.import_module(f"vehicle_roll_sim.command_line.{name}")
    return name, getattr(module, f"{name}_command")


class _ShowVersion(argparse.Action):
    """show program's version number and exit"""

    def __call__(self, parser, *_) -> None:
        from vehicle_roll_sim.version import __version__  # looked up only if needed

        print(f"{PROGRAM} {__version__}")
        parser.exit()
