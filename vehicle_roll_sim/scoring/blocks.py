"""A report as blocks, and the blocks as Markdown and as one HTML page."""

import base64
import dataclasses
import html
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from vehicle_roll_sim.version import __version__

CODE = re.compile(r"`([^`]+)`")
MARKS = re.compile(r"[\\*<\[\]#|]|(?<!\w)_|_(?!\w)")
"""What Markdown would take as more than text."""
BAR = re.compile(r"(?<!\\)\|")
"""In a table also between backticks."""
STYLE = """
:root { color-scheme: light dark; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 75rem; margin: 2rem auto; padding: 0 1rem; }
table { border-collapse: collapse; display: block; overflow-x: auto; margin: 1rem 0; }
th, td { border: 1px solid #8886; padding: 0.25rem 0.6rem; text-align: left; }
th { background: #8882; }
img { max-width: 100%; background: #fff; }
code { font-size: 90%; }
"""
POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"


@dataclasses.dataclass(frozen=True)
class Heading:
    text: str
    level: int = 2


@dataclasses.dataclass(frozen=True)
class Text:
    """A paragraph; words between backticks are code."""

    text: str


@dataclasses.dataclass(frozen=True)
class Points:
    """A list; each item as a Text."""

    items: Sequence[str]


@dataclasses.dataclass(frozen=True)
class Table:
    """Texts; each cell as a Text."""

    head: Sequence[str]
    rows: Sequence[Sequence[str]]


@dataclasses.dataclass(frozen=True)
class Links:
    """A list of files beside the report: label and name of each."""

    items: Sequence[tuple[str, str]]


@dataclasses.dataclass(frozen=True)
class Figure:
    """A picture (SVG) beside the report, which the page contains. about: its text alternative."""

    file: str
    about: str


Block = Heading | Text | Points | Table | Links | Figure


def as_markdown(title: str, blocks: Iterable[Block]) -> str:
    """The report as Markdown, with links to its figures and files."""
    parts = [f"# {_plain(title)}", *(_MARKDOWN[type(block)](block) for block in blocks)]
    return "\n\n".join(parts) + "\n"


def as_page(title: str, blocks: Iterable[Block], folder: Path) -> str:
    """The report as an HTML page that contains its figures, which are in `folder`."""
    body = "\n".join(_page_part(block, folder) for block in blocks)
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<meta name="generator" content="vehicle_roll_sim {html.escape(__version__)}">\n'
        f"<title>{html.escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n"
        f"<body>\n<h1>{html.escape(title)}</h1>\n{body}\n</body>\n</html>\n"
    )


def _plain(text: str) -> str:
    """Text that Markdown shows as it is, but for code, in one line."""
    parts = re.split(r"(`[^`]+`)", " ".join(text.split()))
    return "".join(part if CODE.fullmatch(part) else MARKS.sub(r"\\\g<0>", part) for part in parts)


def _row(cells: Iterable[str]) -> str:
    return "| " + " | ".join(BAR.sub(r"\\|", _plain(cell)) for cell in cells) + " |"


_MARKDOWN = {
    Heading: lambda block: f"{'#' * block.level} {_plain(block.text)}",
    Text: lambda block: _plain(block.text),
    Points: lambda block: "\n".join(f"- {_plain(item)}" for item in block.items),
    Table: lambda block: "\n".join(
        [_row(block.head), _row(["---"] * len(block.head)), *map(_row, block.rows)]
    ),
    Links: lambda block: "\n".join(f"- [{_plain(label)}]({name})" for label, name in block.items),
    Figure: lambda block: f"![{_plain(block.about)}]({block.file})",
}


def _inline(text: str) -> str:
    return CODE.sub(r"<code>\1</code>", html.escape(text))


def _page_part(block: Block, folder: Path) -> str:
    if isinstance(block, Heading):
        return f"<h{block.level}>{_inline(block.text)}</h{block.level}>"
    if isinstance(block, Text):
        return f"<p>{_inline(block.text)}</p>"
    if isinstance(block, Points):
        return _listed(_inline(item) for item in block.items)
    if isinstance(block, Links):
        return _listed(
            f'<a href="{html.escape(name)}">{_inline(label)}</a>' for label, name in block.items
        )
    if isinstance(block, Figure):
        data = base64.b64encode((folder / block.file).read_bytes()).decode()
        about = html.escape(block.about)
        return f'<p><img src="data:image/svg+xml;base64,{data}" alt="{about}"></p>'
    head = "".join(f"<th>{_inline(cell)}</th>" for cell in block.head)
    rows = "\n".join(
        "<tr>" + "".join(f"<td>{_inline(cell)}</td>" for cell in row) + "</tr>"
        for row in block.rows
    )
    return f"<table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}\n</tbody>\n</table>"


def _listed(items: Iterable[str]) -> str:
    return "<ul>\n" + "\n".join(f"<li>{item}</li>" for item in items) + "\n</ul>"
