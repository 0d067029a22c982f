"""The pages of the documentation and the snippets in them."""

import dataclasses
import re
import textwrap
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
PATTERNS = ("*.md", "docs/**/*.md", "msg_examples/*.md")
SOURCES = ("vehicle_roll_sim/**/*.py", "msg_examples/*.py")
NOT_PAGES = ("docs/_build/", "docs/notebooks/")
"""Output of the site build, and notebooks, which the build executes."""
COMMANDS = ("", "bash", "sh", "shell", "console")
"""Languages of blocks with commands; in `console`, lines with a prompt are commands."""
SHOWN = ("text", "ini", "xml", "json", "mermaid", "dockerfile", "makefile", "diff")
"""Languages of blocks that are not run."""
OUTPUT = "<!-- output -->"
"""In the line before a block with the output of the previous command or example."""
FENCE = re.compile(
    r"^(?P<indent> *)(?P<fence>`{3,}|~{3,})(?P<info>[^\n`]*)\n"
    r"(?P<body>.*?)^(?P=indent)(?P=fence) *$",
    re.MULTILINE | re.DOTALL,
)
DIRECTIVE = re.compile(r"\{(?P<name>[\w:-]+)\} *(?P<argument>\S*)")
NAMED = re.compile(r"# (?P<name>\w+\.(py|yaml))\n")
"""The first line of a block to be saved as a file."""
TUTORIALS = "docs/tutorials"
TOCTREE = re.compile(r"^```\{toctree\}\n(:.*\n)*\n(?P<names>[^`]*)^```", re.MULTILINE)
INLINE = re.compile(r"(?<!`)`(?!`)(?P<text>[^`]+)`(?!`)")
TYPED = re.compile(r"(ros2|make|vehicle_roll_sim|python3?|pip|colcon) ")


@dataclasses.dataclass(frozen=True)
class Snippet:
    """A block of code (`language`), or a command within a sentence (`inline`)."""

    page: str
    line: int
    language: str
    text: str
    is_output: bool = False

    @property
    def file_name(self) -> str:
        """The name under which the reader is told to save it, empty for none."""
        named = NAMED.match(self.text)
        return named["name"] if named else ""

    @property
    def place(self) -> str:
        return f"{self.page}:{self.line}"


def pages() -> list[str]:
    """Every page, relative to the root."""
    found = {path.relative_to(ROOT).as_posix() for each in PATTERNS for path in ROOT.glob(each)}
    return sorted(page for page in found if not page.startswith(NOT_PAGES))


def is_quoted(text: str) -> bool:
    """Whether a block is a part of a source file, apart from its indentation."""
    quoted = _unindented(text)
    paths = (path for each in SOURCES for path in ROOT.glob(each))
    return any(quoted in _unindented(path.read_text(encoding="utf-8")) for path in paths)


def _unindented(text: str) -> str:
    return "\n".join(line.strip() for line in text.strip().splitlines())


def lessons() -> list[str]:
    """The tutorials in the order in which they build on each other."""
    index = ROOT / TUTORIALS / "index.md"
    names = TOCTREE.search(index.read_text(encoding="utf-8"))["names"].split()
    return [f"{TUTORIALS}/{name}.md" for name in names]


def snippets(page: str) -> list[Snippet]:
    """The snippets of a page in their order.

    On a page with diffs, inline commands refer to the changed program and are left out.
    """
    found = list(snippets_in((ROOT / page).read_text(encoding="utf-8"), page))
    is_of_changes = any(each.language == "diff" for each in found)
    return [each for each in found if not (is_of_changes and each.language == "inline")]


def snippets_in(text: str, page: str) -> Iterator[Snippet]:
    """The snippets of a text."""
    begin = 0
    for found in FENCE.finditer(text):
        yield from _inline(text, begin, found.start(), page)
        begin = found.end()
        language, body = _language(found["info"]), textwrap.dedent(found["body"])
        is_output = text[: found.start()].rstrip("\n").endswith(OUTPUT)
        if language is not None:
            yield Snippet(page, _line(text, found.start()), language, body, is_output)
    yield from _inline(text, begin, len(text), page)


def _inline(text: str, begin: int, end: int, page: str) -> Iterator[Snippet]:
    for found in INLINE.finditer(text, begin, end):
        words = " ".join(found["text"].split())
        if TYPED.match(words):
            yield Snippet(page, _line(text, found.start()), "inline", words)


def _language(info: str) -> str | None:
    """Of a fence; None for a directive other than code, such as a note or a figure."""
    directive = DIRECTIVE.match(info.strip())
    if directive is None:
        return info.split()[0] if info.split() else ""
    return directive["argument"] if directive["name"] in ("code", "code-block") else None


def _line(text: str, position: int) -> int:
    return text.count("\n", 0, position) + 1
