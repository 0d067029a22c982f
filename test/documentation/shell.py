"""Parses blocks of commands as a shell does, as far as the documentation needs it."""

import dataclasses
import re
import shlex
from collections.abc import Callable, Mapping

PROMPT = "$ "
BETWEEN = ("&&", ";", "&")
SUBSTITUTION = re.compile(r"\$\((?P<command>[^()]*)\)")
VARIABLE = re.compile(r"\$(?P<name>[A-Za-z_]\w*)")
CONTINUED = re.compile(r"\\\n *")


@dataclasses.dataclass(frozen=True)
class Line:
    """What is typed, and what is shown below it."""

    typed: str
    shown: str = ""

    @property
    def shows(self) -> bool:
        return bool(self.shown.strip())


def lines_of(language: str, text: str) -> list[Line]:
    """The lines that a block has the reader type."""
    text = CONTINUED.sub(" ", text)
    if language != "console":
        return [Line(line) for line in text.splitlines() if line.strip()]
    sessions = re.split(rf"^{re.escape(PROMPT)}", text, flags=re.MULTILINE)
    assert not sessions[0].strip(), f"a line before the first {PROMPT!r}"
    typed_and_shown = (session.partition("\n") for session in sessions[1:])
    return [Line(typed, shown) for typed, _, shown in typed_and_shown]


def commands_of(line: str) -> list[list[str]]:
    """The commands of a line, each as words."""
    held: list[str] = []  # substitutions, whose parentheses are not the shell's

    def hold(found: re.Match) -> str:
        held.append(found[0])
        return f"HELD{len(held) - 1}HELD"

    reader = shlex.shlex(SUBSTITUTION.sub(hold, line), posix=True, punctuation_chars=";&")
    reader.whitespace_split = True
    commands: list[list[str]] = [[]]
    for word in reader:
        if word in BETWEEN:
            commands.append([])
        else:
            commands[-1].append(re.sub(r"HELD(\d+)HELD", lambda m: held[int(m[1])], word))
    return [words for words in commands if words]


def expanded(word: str, run: Callable[[str], str], variables: Mapping[str, str]) -> str:
    """A word with what `$(command)` prints and `$NAME` stands for."""
    word = SUBSTITUTION.sub(lambda found: run(found["command"]), word)
    return VARIABLE.sub(lambda found: variables.get(found["name"], found[0]), word)
