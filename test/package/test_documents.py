"""What the documents tell a user to type is there: executables, launch files, commands."""

import re

import pytest

from vehicle_roll_sim.command_line.main import COMMANDS

PACKAGE = "vehicle_roll_sim"
RUN = re.compile(rf"ros2 run {PACKAGE} (?!NAME)(\w+)(?: (\w+))?")
"""NAME stands for any of a table."""
LAUNCH = re.compile(rf"ros2 launch {PACKAGE} ([a-z_]+)\.launch\.py")
BLOCK = re.compile(r"^```\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMMANDS_IN_THE_CHECKLIST = 20
TITLE = re.compile(r"^### (\d+)\. ", re.MULTILINE)


@pytest.fixture(scope="module")
def pages(root) -> dict[str, str]:
    """Every page there is to read, by name."""
    found = [
        root / "README.md",
        *(root / "docs").glob("*.md"),
        *(root / "msg_examples").glob("*.md"),
    ]
    return {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in found}


@pytest.fixture(scope="module")
def executables(root) -> set[str]:
    """The names that setup.py installs."""
    text = (root / "setup.py").read_text(encoding="utf-8")
    examples = re.search(r"^EXAMPLES = \((.*?)\)", text, re.MULTILINE | re.DOTALL).group(1)
    return {*re.findall(r"f\"(\w+) = \{NAME\}", text), *re.findall(r"\w+", examples)}


def test_every_executable_that_is_named_is_installed(pages, executables):
    assert {"simulator", PACKAGE} <= executables
    named = {(page, *found) for page, text in pages.items() for found in RUN.findall(text)}
    assert {"simulator", "manoeuvre", "recorder", "offline"} <= {name for _, name, _ in named}
    for page, name, command in named:
        assert name in executables, page
        if name in ("offline", PACKAGE) and command:
            assert command in COMMANDS, page


def test_every_launch_file_that_is_named_is_installed(pages, root):
    there = {path.name for path in (root / PACKAGE / "launch").glob("*.launch.py")}
    named = {(page, name) for page, text in pages.items() for name in LAUNCH.findall(text)}
    assert {f"{name}.launch.py" for _, name in named} == there


@pytest.mark.parametrize("page", ["README.md", "docs/interfaces.md"])
def test_how_the_command_is_called_in_a_workspace_is_said(pages, page):
    """There it is not on the path."""
    assert f"ros2 run {PACKAGE} offline run j_turn" in pages[page]


def test_the_checklist_has_its_commands_each_with_what_must_come_out(pages):
    text = pages["docs/ros2_checklist.md"]
    numbers = [int(number) for number in TITLE.findall(text)]
    assert numbers == list(range(1, COMMANDS_IN_THE_CHECKLIST + 1))
    for section in TITLE.split(text)[2::2]:
        assert BLOCK.search(section), section
        assert "Expected" in section
