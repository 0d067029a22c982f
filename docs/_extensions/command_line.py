"""The directive `command-line`: usage and options of a command, from the parser that reads them.

    ```{command-line} vehicle_roll_sim run
    ```

The first word is an executable of the package, found by its entry point. It is asked for `--help`,
and the parser that would print it is taken instead: nothing depends on where a parser is made.
"""

import argparse
import contextlib
import re
import signal
import sys
from importlib.metadata import distribution
from unittest import mock

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective

PACKAGE = "vehicle_roll_sim"
SIGNALS = (signal.SIGINT, signal.SIGTERM)
CODE = re.compile(r"(`[^`]+`|(?<![\w-])--[a-z][a-z-]*)")
STANDARD_GROUPS = {"positional arguments": "arguments"}


@contextlib.contextmanager
def signals_kept():
    """Commands install signal handlers of their own; those of the build are put back."""
    before = {each: signal.getsignal(each) for each in SIGNALS}
    try:
        yield
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)


def parser_of(words: list[str]) -> argparse.ArgumentParser:
    """The parser that answers `--help` behind `words`."""
    (entry_point,) = distribution(PACKAGE).entry_points.select(
        group="console_scripts", name=words[0]
    )
    found = []

    def take(parser: argparse.ArgumentParser, _file=None) -> None:
        found.append(parser)

    with (
        signals_kept(),
        mock.patch.object(argparse.ArgumentParser, "print_help", take),
        mock.patch.object(sys, "argv", [*words, "--help"]),
        contextlib.suppress(SystemExit),
    ):
        entry_point.load()()
    if not found:
        raise ExtensionError(f"{' '.join(words)} --help: no help; is ROS 2 installed?")
    found[0].prog = " ".join(words)
    return found[0]


def usage(parser: argparse.ArgumentParser) -> str:
    """One line, with the options abridged: they follow in tables."""
    if parser.usage:
        return parser.usage
    required = [action for action in parser._actions if action.required and action.option_strings]
    positional = [action for action in parser._actions if not action.option_strings]
    words = [f"{action.option_strings[0]} {_value(action)}" for action in required]
    words += [_value(action) for action in positional]
    return " ".join([parser.prog, *words, "[options]"])


def _value(action: argparse.Action) -> str:
    """The placeholder of an action's value or values."""
    if action.nargs == 0:
        return ""
    names = action.metavar or action.dest.upper()
    text = names if isinstance(names, str) else " ".join(names)
    return {"?": f"[{text}]", "+": f"{text} [{text} ...]", "*": f"[{text} ...]"}.get(
        action.nargs, text
    )


def tables(parser: argparse.ArgumentParser) -> list[tuple[str, list[tuple[str, str]]]]:
    """Title and rows (option, meaning) of every group of the parser that has options."""
    formatter = parser.formatter_class(prog=parser.prog)
    merged: dict[str, list[tuple[str, str]]] = {}
    for group in parser._action_groups:
        rows = merged.setdefault(STANDARD_GROUPS.get(group.title, group.title), [])
        for action in group._group_actions:
            name = ", ".join(action.option_strings)
            about = formatter._expand_help(action) if action.help else ""
            rows.append((f"{name} {_value(action)}".strip(), about))
    return [(title, rows) for title, rows in merged.items() if rows]


class CommandLine(SphinxDirective):
    """Description, usage and one table for each group of options."""

    required_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        parser = parser_of(self.arguments[0].split())
        shown = [nodes.paragraph("", parser.description or "")] if parser.description else []
        shown.append(nodes.literal_block("", usage(parser), language="text"))
        for title, rows in tables(parser):
            shown.append(nodes.rubric("", title.capitalize()))
            shown.append(nodes.definition_list("", *(_entry(*row) for row in rows)))
        return shown


def _entry(option: str, about: str) -> nodes.definition_list_item:
    term = nodes.term("", "", nodes.literal("", option))
    text = re.sub(r"\s+", " ", about)
    definition = nodes.definition("", nodes.paragraph("", "", *_inline(text)))
    return nodes.definition_list_item("", term, definition)


def _inline(text: str) -> list[nodes.Node]:
    """A help text, with what it has in backticks and the options that it names as code."""
    parts = CODE.split(text)
    return [
        nodes.literal("", part.strip("`")) if index % 2 else nodes.Text(part)
        for index, part in enumerate(parts)
    ]


def setup(app: Sphinx) -> dict:
    app.add_directive("command-line", CommandLine)
    return {"parallel_read_safe": True}
