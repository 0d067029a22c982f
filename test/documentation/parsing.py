"""Checks the arguments of a command with its own parser, without running it."""

import argparse
import contextlib
import importlib.metadata
import io
import signal
import sys
from collections.abc import Iterator
from unittest import mock

from vehicle_roll_sim.arguments import OneLineParser

PACKAGE = "vehicle_roll_sim"
OFFLINE = ("offline", PACKAGE)
"""Executables that run the command `vehicle_roll_sim`."""


class Parsed(Exception):  # noqa: N818, no error
    """Raised instead of running the parsed command."""

    def __init__(self, arguments: argparse.Namespace):
        super().__init__()
        self.arguments = arguments


def executables() -> dict[str, importlib.metadata.EntryPoint]:
    """The executables of the installed package by name."""
    found = importlib.metadata.distribution(PACKAGE).entry_points
    return {each.name: each for each in found if each.group == "console_scripts"}


def arguments_of(name: str, words: list[str]) -> argparse.Namespace:
    """The arguments as an executable parses them; AssertionError if it refuses them."""
    known = executables()
    assert name in known, f"no executable {name}, only {', '.join(known)}"
    said = io.StringIO()
    with _only_parsing(), contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
        sys.argv = [name, *words]
        try:
            status = known[name].load()()
        except Parsed as parsed:
            return parsed.arguments
        except SystemExit as ended:
            status = ended.code
    raise AssertionError(f"status {status}: {said.getvalue()}")


def help_of(name: str, words: list[str]) -> str:
    """The help text that an executable prints for these words and `--help`."""
    said = io.StringIO()
    given = mock.patch.object(sys, "argv", [name, *words, "--help"])
    with given, _deaf(), contextlib.redirect_stdout(said), contextlib.suppress(SystemExit):
        executables()[name].load()()
    return said.getvalue()


@contextlib.contextmanager
def _only_parsing() -> Iterator[None]:
    parse = OneLineParser.parse_args

    def parsed(parser, words=None, namespace=None):
        arguments = parse(parser, words, namespace)
        if parser.prog == PACKAGE:  # that of the subcommand comes next
            return arguments
        raise Parsed(arguments)

    given = mock.patch.object(sys, "argv", [])
    with mock.patch.object(OneLineParser, "parse_args", parsed), given, _deaf():
        yield


def _deaf() -> contextlib.AbstractContextManager:
    """Context in which signal handlers cannot be changed."""
    return mock.patch.object(signal, "signal")
