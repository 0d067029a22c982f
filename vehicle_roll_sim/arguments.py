"""Command-line options from the declarations, and errors in one line."""

import argparse
import io
import os
import re
import sys
from collections.abc import Callable, Container
from pathlib import Path

from vehicle_roll_sim.declaration import (
    InputError,
    NotWrittenError,
    Parameter,
    number_in,
    parameters_of,
    unknown_name,
)

WRONG_INPUT = 2
"""Exit status after wrong usage or input."""
REFUSED = 1
"""Exit status when the system refused something, such as to write."""
INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells have it."""


NEGATIVE_NUMBER = re.compile(r"-(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")


class OneLineParser(argparse.ArgumentParser):
    """A parser that says what is wrong in one line, with the nearest option for a misspelt one."""

    def __init__(self, **settings):
        settings.setdefault("allow_abbrev", False)
        super().__init__(**settings)
        self._negative_number_matcher = NEGATIVE_NUMBER  # argparse's own knows no exponent

    def error(self, message: str):
        unknown = message.partition("unrecognized arguments: ")[2].split()
        if unknown and unknown[0].startswith("-"):
            options = [name for action in self._actions for name in action.option_strings]
            raise unknown_name(unknown[0], options, "option")
        raise InputError("arguments", "", "--help shows how", message)


def exit_status(command: Callable[[], int], program: str) -> int:
    """Run `command`; what goes wrong in its surroundings becomes one line on stderr.

    Status 2 for what the user gave, 1 for what the system refused, 130 after Ctrl-C. A reader of
    our output that has gone, as `head` does, or was never there is none of these.
    """
    _show_anything()
    try:
        status = command()
        sys.stdout.flush()
    except InputError as error:
        print(f"{program}: error: {error}", file=sys.stderr)
        return REFUSED if isinstance(error, NotWrittenError) else WRONG_INPUT
    except KeyboardInterrupt:
        print(f"{program}: interrupted", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        _write_no_more()
        return 0
    except OSError as error:
        _write_no_more()
        print(f"{program}: error: {error}", file=sys.stderr)
        return REFUSED
    return status


def _show_anything() -> None:
    """Have stdout and stderr take any text: escaped where they lack a character, or nowhere."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by whoever started us
            setattr(sys, name, open(os.devnull, "w"))  # noqa: SIM115
        if isinstance(getattr(sys, name), io.TextIOWrapper):
            getattr(sys, name).reconfigure(errors="backslashreplace")


def _write_no_more() -> None:
    """Whatever is still in the buffer of stdout goes nowhere."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def option_name(parameter: Parameter) -> str:
    return "--" + parameter.name.replace("_", "-")


def add_declared(
    parser: argparse.ArgumentParser, declaring, title: str, without: Container[str] = ()
) -> None:
    """An option for every parameter of a dataclass, or of an instance that has the defaults.

    An option that the parser has already is left as it is. without: names that get none.
    """
    groups = {group.title: group for group in parser._action_groups}
    group = groups.get(title) or parser.add_argument_group(title)
    for parameter in parameters_of(declaring).values():
        is_there = any(action.dest == parameter.name for action in parser._actions)
        if is_there or parameter.name in without:
            continue
        about = parameter.description
        if parameter.kind is bool:
            group.add_argument(option_name(parameter), action="store_true", help=about)
            continue
        if parameter.choices:
            about += ": " + ", ".join(parameter.choices)
        default = getattr(declaring, parameter.name, None)
        if isinstance(default, float):
            about += f" (default {default:.6g})"
        unit = parameter.unit.upper() or "VALUE"
        group.add_argument(option_name(parameter), metavar=unit.replace(" ", "_"), help=about)


def declared_values(arguments: argparse.Namespace, declaring) -> dict:
    """The parameters that were given on the command line, checked."""
    values = {}
    for name, parameter in parameters_of(declaring).items():
        given = getattr(arguments, name, None)  # None as well where it has no option
        if given is None:
            continue
        if parameter.kind is float:
            given = number(given, option_name(parameter), parameter)
        values[name] = parameter.validate(given, option_name(parameter))
    return values


def number(text: str, field: str, parameter: Parameter) -> float:
    """The number that a word on the command line is; raises InputError naming `field`."""
    try:
        return number_in(text)
    except ValueError:
        raise InputError(field, text, parameter.allowed) from None


def named_file(text: str | None, option: str) -> Path | None:
    """The file that an option names, None where it was not given."""
    if text == "":
        raise InputError(option, text, "the name of a file")
    return Path(text) if text else None
