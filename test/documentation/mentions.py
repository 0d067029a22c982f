"""Commands mentioned in a sentence, complete or in part: what they name must exist."""

import re

import parsing
from pages import ROOT

from vehicle_roll_sim.command_line.main import COMMANDS

PLACEHOLDER = re.compile(r"[A-Z]{2,}[A-Z_\d]*(\.\w+)*$|[\[({|…)]|DIR")
"""A placeholder: FILE, [options], ( | ), …"""
OPTION = re.compile(r"--[a-z][a-z-]+")
TARGET = re.compile(r"^([a-z-]+):", re.MULTILINE)


def is_whole(words: list[str]) -> bool:
    """Whether the words form a complete command, without placeholders."""
    return len(words) > 3 and not any(PLACEHOLDER.match(word) for word in words)


def look_up_target(name: str) -> None:
    targets = TARGET.findall((ROOT / "Makefile").read_text(encoding="utf-8"))
    assert name in targets, f"no target {name} in the Makefile"


def check_executable(package: str, words: list[str]) -> None:
    """After `ros2 run`: check the executable and, for the command, its arguments."""
    assert package == parsing.PACKAGE, f"no package {package}"
    assert words[0] in parsing.executables(), f"no executable {words[0]}"
    if words[0] in parsing.OFFLINE and len(words) > 1:
        check_command(words[1:])


def check_command(words: list[str]) -> None:
    """After `vehicle_roll_sim`: check the command and its options."""
    if words[0].startswith("--"):
        return
    assert words[0] in COMMANDS, f"no command {words[0]}"
    options = set(OPTION.findall(" ".join(words)))
    missing = options - set(OPTION.findall(parsing.help_of(parsing.PACKAGE, words[:1])))
    assert not missing, f"{words[0]} has no option {' '.join(missing)}"
