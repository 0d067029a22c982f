"""Command-line options generated from parameter declarations; errors as one line."""

import argparse
import io
import json
import os
import re
import sys
from collections.abc import Callable, Container
from pathlib import Path

from vehicle_roll_sim.declaration import InputError, Parameter, parameters_of, unknown_name
from vehicle_roll_sim.input_errors import NotWrittenError, number_in

WRONG_INPUT = 2
"""Exit status for a usage error or invalid input."""
REFUSED = 1
"""Exit status when the operating system refused an operation, such as writing a file."""
INTERRUPTED = 130
"""Exit status after Ctrl-C, by shell convention."""


NEGATIVE_NUMBER = re.compile(r"-(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")


class OneLineParser(argparse.ArgumentParser):
    """An argument parser that reports errors as one line and suggests the closest option."""

    def __init__(self, **settings):
        settings.setdefault("allow_abbrev", False)
        super().__init__(**settings)
        self._negative_number_matcher = NEGATIVE_NUMBER  # argparse's own pattern lacks exponents

    def error(self, message: str):
        unknown = message.partition("unrecognized arguments: ")[2].split()
        if unknown and unknown[0].startswith("-"):
            options = [name for action in self._actions for name in action.option_strings]
            raise unknown_name(unknown[0], options, "option")
        raise InputError("arguments", "", "see --help", message)


def exit_status(command: Callable[[], int], program: str) -> int:
    """Run `command` and return its exit status; expected errors are printed as one line on stderr.

    Status 2 for invalid input, 1 if the operating system refused an operation, 130 after Ctrl-C.
    A closed output pipe, as after `| head`, is not an error (status 0).
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
    """Make stdout and stderr accept any text.

    Characters that the encoding lacks are escaped; a closed stream is replaced by the null device.
    """
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by the parent process
            setattr(sys, name, open(os.devnull, "w"))  # noqa: SIM115
        if isinstance(getattr(sys, name), io.TextIOWrapper):
            getattr(sys, name).reconfigure(errors="backslashreplace")


def _write_no_more() -> None:
    """Redirect stdout to the null device, so that flushing its buffer cannot fail."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def option_name(parameter: Parameter) -> str:
    """The command-line option of a parameter: --tire-radius for tire_radius."""
    return "--" + parameter.name.replace("_", "-")


def add_declared(
    parser: argparse.ArgumentParser, declaring, title: str, without: Container[str] = ()
) -> None:
    """Add a group with one option per parameter of a dataclass or instance.

    The defaults shown are those of `declaring`. Options that the parser already has are left
    unchanged. without: names of parameters that get no option.
    """
    groups = {group.title: group for group in parser._action_groups}
    group = groups.get(title) or parser.add_argument_group(title)
    for parameter in parameters_of(declaring).values():
        is_there = any(action.dest == parameter.name for action in parser._actions)
        if is_there or parameter.name in without:
            continue
        about = parameter.description.replace("%", "%%")  # argparse formats help texts
        if parameter.kind is bool:
            group.add_argument(option_name(parameter), action="store_true", help=about)
            continue
        if parameter.choices:
            about += ": " + ", ".join(parameter.choices)
        default = getattr(declaring, parameter.name, None)
        if isinstance(default, float | int):
            about += f" (default {default:.6g})"
        elif parameter.none and default is None:
            about += f" (default: {parameter.none})"
        unit = parameter.unit.upper() or "VALUE"
        group.add_argument(option_name(parameter), metavar=unit.replace(" ", "_"), help=about)


def declared_values(arguments: argparse.Namespace, declaring) -> dict:
    """The parameters given on the command line, by name, validated; raises InputError."""
    values = {}
    for name, parameter in parameters_of(declaring).items():
        given = getattr(arguments, name, None)  # also None if the parameter has no option
        if given is None:
            continue
        if parameter.kind in (float, int):
            given = number(given, option_name(parameter), parameter)
        values[name] = parameter.validate(given, option_name(parameter))
    return values


def number(text: str, field: str, parameter: Parameter) -> float | list:
    """Parse a number, or the table of a Curve, given on the command line.

    Raises InputError naming `field`.
    """
    try:
        if parameter.is_curve and text.lstrip().startswith("["):
            return json.loads(text)
        return number_in(text)
    except (ValueError, RecursionError):
        raise InputError(field, text, parameter.allowed) from None


def named_file(text: str | None, option: str) -> Path | None:
    """The path given with an option, or None if it was not given."""
    if text == "":
        raise InputError(option, text, "the name of a file")
    return Path(text) if text else None
