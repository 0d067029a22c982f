"""Texts outside docs/ in the site: included by a page of their own, which links lead to.

On GitHub `../CONTRIBUTING.md` is right; in the site the page is `contributing`, which has that text
by an `{include}`. Links in an included Markdown file are relative to that file, and are made
relative to the page. Other files outside docs/, such as the licence, become downloads, as MyST
has it.
"""

import os.path
import re
from pathlib import Path

from sphinx.application import Sphinx

PAGES = {
    "README.md": "index.md",
    "CHANGELOG.rst": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
    "SECURITY.md": "security.md",
    "msg_examples/README.md": "msg_examples.md",
}
"""By path from the root; the page by its path from docs/."""
INCLUDE = re.compile(r"^```\{include\} (\S+\.md)\n```$", re.MULTILINE)
LINK = re.compile(r"\]\((?!https?:|#)([^)#\s]+)(#[^)\s]*)?\)")


def included(text: str, folder: Path) -> str:
    """The text of a page in `folder`, with the Markdown files that it includes in their places."""

    def insert(found: re.Match) -> str:
        file = folder / found[1]

        def moved(link: re.Match) -> str:
            path = os.path.relpath(file.parent / link[1], folder)
            return f"]({path}{link[2] or ''})"

        return LINK.sub(moved, file.read_text(encoding="utf-8"))

    return INCLUDE.sub(insert, text)


def within_the_site(text: str, folder: Path, docs: Path) -> str:
    """The text of a page in `folder` with its links to `PAGES` as the site needs them."""

    def led(link: re.Match) -> str:
        page = PAGES.get(os.path.relpath(folder / link[1], docs.parent))
        return f"]({os.path.relpath(docs / page, folder)})" if page else link[0]

    return LINK.sub(led, text)


def setup(app: Sphinx) -> dict:
    def rewrite(app: Sphinx, page: str, source: list[str]) -> None:
        docs, folder = Path(app.srcdir), Path(app.srcdir, page).parent
        for name in INCLUDE.findall(source[0]):
            app.env.note_dependency(str(folder / name))
        source[0] = within_the_site(included(source[0], folder), folder, docs)

    app.connect("source-read", rewrite)
    return {"parallel_read_safe": True}
