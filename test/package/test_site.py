"""The documentation site: every page is in its contents, and its reference pages are complete.

`make docs` builds it; a warning, such as of a broken link, fails the build.
"""

import re
from pathlib import Path

import pytest

import vehicle_roll_sim
from vehicle_roll_sim.command_line.commands import COMMANDS

TOCTREE = re.compile(r"^```\{toctree\}\n((?::[^\n]*\n)*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
DIRECTIVE = re.compile(r"^```\{([\w-]+)\} (.+)$", re.MULTILINE)
AUTODOC = re.compile(r"^\.\. auto\w+:: ([\w.]+)", re.MULTILINE)
NODES = {"simulator", "manoeuvre", "recorder", "live_view", "demo", "compare"}


def listed(docs: Path, page: str) -> list[str]:
    """The pages in the contents of a page, including those of its subpages."""
    found = []
    for _, names in TOCTREE.findall((docs / f"{page}.md").read_text(encoding="utf-8")):
        for name in names.split():
            path = (Path(page).parent / name).as_posix()
            found += [path, *listed(docs, path)]
    return found


@pytest.fixture(scope="module")
def docs(root) -> Path:
    return root / "docs"


def reference(docs: Path, page: str) -> str:
    return (docs / "reference" / f"{page}.md").read_text(encoding="utf-8")


def test_every_page_is_in_the_contents_once(docs):
    there = {path.relative_to(docs).with_suffix("").as_posix() for path in docs.glob("**/*.md")}
    found = listed(docs, "index")
    assert sorted(found) == sorted(there - {"index"})


def test_the_contents_go_from_learning_to_contributing(docs):
    text = (docs / "index.md").read_text(encoding="utf-8")
    captions = re.findall(r"^:caption: (.+)$", text, re.MULTILINE)
    assert captions == [
        "Tutorials",
        "How-to guides",
        "Reference",
        "Explanation",
        "For contributors",
    ]


def test_every_command_and_node_has_its_options_in_the_reference(docs):
    shown = [words for name, words in DIRECTIVE.findall(reference(docs, "command_line"))]
    expected = {f"{vehicle_roll_sim.__name__} {command}" for command in COMMANDS} | NODES
    assert sorted(shown) == sorted(expected)


def test_every_public_name_is_in_the_reference(docs):
    text = reference(docs, "python_api")
    documented = {name.rpartition(".")[2] for name in AUTODOC.findall(text)}
    documented |= set(re.findall(r"`(\w+)`", text))
    assert set(vehicle_roll_sim.__all__) <= documented
    assert {"Controller", "Topic", "by_name"} <= documented
