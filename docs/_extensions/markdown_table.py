"""Tables in Markdown, and sentences of declarations in their cells."""

import re
from collections.abc import Iterable

NAME = re.compile(r"(?<![\w`/])(/\w+|\w+_\w+)")
"""In a sentence of a declaration: the name of a topic, a parameter or a frame."""


def table(*rows: Iterable[str]) -> str:
    """A Markdown table whose first row is its header."""
    head, *body = map(list, rows)
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *body])


def with_names(text: str) -> str:
    """A sentence with the names in it as code."""
    return NAME.sub(r"`\1`", text)
