"""Required contents of the documents. test/documentation checks that their commands work."""

import re

import pytest

PACKAGE = "vehicle_roll_sim"
LAUNCH = re.compile(rf"ros2 launch {PACKAGE} ([a-z_]+)\.launch\.py")
BLOCK = re.compile(r"^```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMMANDS_IN_THE_CHECKLIST = 20
TITLE = re.compile(r"^### (\d+)\. ", re.MULTILINE)
LINK = re.compile(r"\]\((?!https?:|mailto:)([^)#\s]*)(?:#([^)\s]+))?\)")
HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)


def anchors(text: str) -> set[str]:
    """The anchors of the headings of a page, as GitHub and MyST make them."""
    plain = (re.sub(r"[^\w\- ]", "", heading.lower()) for heading in HEADING.findall(text))
    return {heading.replace(" ", "-") for heading in plain}


@pytest.fixture(scope="module")
def pages(root) -> dict[str, str]:
    """The text of every page, by name."""
    found = [
        root / "README.md",
        *(root / "docs").glob("**/*.md"),
        *(root / "msg_examples").glob("*.md"),
        root / "CONTRIBUTING.md",
        root / "SECURITY.md",
    ]
    return {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in found}


def test_every_launch_file_is_on_a_page(pages, root):
    there = {path.name for path in (root / PACKAGE / "launch").glob("*.launch.py")}
    named = {(page, name) for page, text in pages.items() for name in LAUNCH.findall(text)}
    assert {f"{name}.launch.py" for _, name in named} == there


@pytest.mark.parametrize("page", ["docs/installation.md", "docs/reference/command_line.md"])
def test_how_the_command_is_called_in_a_workspace_is_said(pages, page):
    """In a workspace the command is not on the path."""
    assert f"ros2 run {PACKAGE} offline run j_turn" in pages[page]


def test_the_checklist_has_its_commands_each_with_what_must_come_out(pages):
    text = pages["docs/ros2_checklist.md"]
    numbers = [int(number) for number in TITLE.findall(text)]
    assert numbers == list(range(1, COMMANDS_IN_THE_CHECKLIST + 1))
    for section in TITLE.split(text)[2::2]:
        assert BLOCK.search(section), section
        assert "Expected" in section


def test_every_link_within_the_project_leads_to_a_file_and_a_heading(pages, root):
    for page, text in pages.items():
        for target, anchor in LINK.findall(BLOCK.sub("", text)):
            path = (root / page).parent / target if target else root / page
            assert path.exists(), f"{page}: {target}"
            if anchor:
                assert anchor in anchors(path.read_text(encoding="utf-8")), f"{page}: #{anchor}"


def test_the_readme_is_one_page_and_leads_to_the_rest(pages):
    readme = pages["README.md"]
    assert len(readme.splitlines()) <= 100
    named = {target for target, _ in LINK.findall(readme)}
    assert {"docs/installation.md", "docs/interfaces.md", "docs/tutorials/index.md"} <= named
