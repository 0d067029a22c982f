"""A reader who types the commands of a page in an empty folder."""

import contextlib
import io
import itertools
import os
import re
import runpy
import subprocess
import sys
from pathlib import Path
from unittest import mock

import mentions
import outputs
import parsing
import yaml
from not_run import pattern_of
from pages import COMMANDS, ROOT, SHOWN, Snippet, is_quoted
from parsing import OFFLINE, PACKAGE
from shell import Line, commands_of, expanded, lines_of

from vehicle_roll_sim.command_line.main import main

try:
    import nodes
except ImportError:  # ROS 2 is not installed
    nodes = None

BY_SHELL = ("ls", "cat", "head", "tail", "mkdir", "cp", "wc")
OUTPUT_OPTIONS = ("--csv", "--bag", "--plot", "--output")
EXAMPLES = (
    *("car.yaml", "tire.tir", "commands.csv", "log.csv", "log_map.yaml"),
    "design_lqr_roll_bar.py",
)
"""Files of `examples/` that a reader has who is told nothing else of them."""


class Reader:
    """Types one snippet after the other; `count` has how many were run, checked and not run.

    own: files that the reader has where nothing on the page makes them, by name.
    """

    def __init__(self, folder: Path, own: dict[str, str]):
        self.home = self.here = folder
        self._own = {name: (ROOT / "examples" / name).read_text() for name in EXAMPLES} | own
        self.count = {"run": 0, "checked": 0, "not run": 0}
        self._variables: dict[str, str] = {}
        self._names = {"__name__": "__main__"}
        self._promised: dict[str, list[str]] = {}  # what nodes would have written: by which words
        self._printed, self._failed = "", False

    def read(self, snippet: Snippet) -> None:
        """Do what a snippet says; AssertionError tells where and why that is not possible."""
        try:
            with contextlib.chdir(self.here):
                self._read(snippet)
        except Exception as error:
            text = f"{type(error).__name__}: {error}"
            raise AssertionError(f"{snippet.place}: {text}\n{snippet.text}") from error

    def _read(self, snippet: Snippet) -> None:
        if snippet.language == "inline":
            self._mention(snippet.text)
        elif snippet.is_output:
            self._compare(snippet.text)
        elif snippet.language in COMMANDS:
            for line in lines_of(snippet.language, snippet.text):
                self._type(line)
        elif snippet.file_name:
            Path(snippet.file_name).write_text(snippet.text, encoding="utf-8")
        elif snippet.language == "python" and is_quoted(snippet.text):
            self.count["checked"] += 1
        elif snippet.language == "python":
            code = compile(snippet.text, snippet.place, "exec")
            self._printed = _printed_by(exec, code, self._names)[1]
            self.count["run"] += 1
        elif snippet.language == "yaml":
            for command in _commands_in(yaml.safe_load(snippet.text)):
                self._type(Line(command), may_fail=command.startswith("python "))
        else:
            assert snippet.language in SHOWN, f"nobody knows how to try {snippet.language}"

    def _mention(self, text: str) -> None:
        """A command within a sentence: what it names is there. It need not be whole."""
        words = text.split()
        if pattern_of(text) and words[0] != "make":
            return
        if words[0] == "make":
            mentions.look_up_target(words[1])
        elif words[0] == "ros2" and nodes is None:
            return
        elif words[0] == "ros2" and len(words) > 3 and words[1] in ("topic", "service", "param"):
            nodes.check_talk([self._expanded(word) for word in commands_of(text)[0][1:]])
        elif words[:2] == ["ros2", "launch"] and mentions.is_whole(words):
            nodes.check_launch(words[3], words[4:])
        elif words[:2] == ["ros2", "run"] and mentions.is_whole(words):
            mentions.check_executable(words[2], words[3:])
        elif words[0] == PACKAGE and words[1] not in parsing.executables():
            mentions.check_command(words[1:])
        self.count["checked"] += 1

    def _compare(self, shown: str) -> None:
        assert outputs.same(shown, self._printed), f"what comes out is\n{self._printed}"

    def _type(self, line: Line, may_fail: bool = False) -> None:
        """may_fail: its status is a finding of the reader's, as that of a job's last step."""
        self._printed, self._failed = "", False
        for words in commands_of(line.typed):
            self._do([self._expanded(word) for word in words], line)
        if line.shows:
            self._compare(line.shown)
        is_error_shown = ": error: " in line.shown
        assert may_fail or self._failed == is_error_shown, self._printed

    def _expanded(self, word: str) -> str:
        return expanded(word, self._substitute, self._variables)

    def _substitute(self, command: str) -> str:
        if command == f"ros2 pkg prefix --share {PACKAGE}":
            return str(self.home.parent / "share")
        words = command.split()
        assert words[0] == "cat", f"nobody knows how to try $({command})"
        there = Path(words[1])
        return (there if there.exists() else ROOT / "msg_examples" / there).read_text().strip()

    def _do(self, words: list[str], line: Line) -> None:
        """Do what a command says."""
        first, *rest = words
        command = " ".join(words)
        if pattern := pattern_of(command):
            self._leave(pattern, words)
        elif words[:3] == ["ros2", "run", PACKAGE]:
            self._run_executable(words[3], words[4:], line)
        elif first == PACKAGE:
            self._run_command(rest)
        elif words[:2] in (["python", "-m"], ["python3", "-m"]) and words[2] == PACKAGE:
            self._run_command(words[3:])
        elif first in parsing.executables():
            self._run_executable(first, rest, line)
        elif words[:3] == ["ros2", "launch", PACKAGE]:
            self._launch(words[3], words[4:])
        elif first == "ros2":
            self._check_with_ros("check_talk", rest)
        elif first == "export":
            self._variables |= dict(word.split("=", 1) for word in rest)
        elif re.fullmatch(r"\w+=\S+", command):
            self._variables |= dict([command.split("=", 1)])
        elif first == "cd":
            self.here = (self.here / rest[0]).resolve()
            os.chdir(self.here)
        elif first in ("python", "python3") and rest[0].endswith(".py"):
            self._run_script(rest)
        else:
            assert first in BY_SHELL, f"nobody knows how to try {command}"
            done = subprocess.run(words, capture_output=True, text=True, check=False)
            self._has_run(done.returncode, done.stdout + done.stderr)

    def _leave(self, pattern: str, words: list[str]) -> None:
        """What is not run: targets and files that it names are there."""
        self.count["not run"] += 1
        if words[0] == "make":
            mentions.look_up_target(words[1])
        for word in words:
            if str(self.home.parent / "share") in word:
                assert Path(word).exists(), f"no file {word}"
        self._promise(words, ["run", "step_steer", "--command-period", "0.01"])

    def _run_executable(self, name: str, words: list[str], line: Line) -> None:
        if name in OFFLINE:
            self._run_command(words)
            return
        self._bring_own(words)
        self._check_with_ros("check_run", name, words)
        if name == "manoeuvre":
            own = ["run", *words, "--command-period", "0.01"]
            self._promise(words, own)
            if line.shows:
                self._has_run(*_printed_by(main, own))
        elif name == "compare" and line.shows and nodes:
            self._has_run(*_printed_by(nodes.run_compare, words))
        else:
            self._promise(words, ["run", "j_turn", "--command-period", "0.01"])

    def _launch(self, name: str, words: list[str]) -> None:
        self._bring_own([word.partition(":=")[2] for word in words])
        self._check_with_ros("check_launch", name, words)
        bags = [word.removeprefix("bag:=") for word in words if word.startswith("bag:=")]
        for bag in bags:
            self._promised[bag] = ["run", "j_turn", "--bag", bag]

    def _check_with_ros(self, check: str, *given) -> None:
        if nodes:
            getattr(nodes, check)(*given)
        self.count["checked" if nodes else "not run"] += 1

    def _promise(self, words: list[str], own: list[str]) -> None:
        """Have files ready, should they be read, that a node would have left."""
        for option, name in itertools.pairwise(words):
            if option in OUTPUT_OPTIONS and not Path(name).exists():
                kind = "--bag" if option == "--output" else option
                self._promised[name] = [*own[:2], kind, name]

    def _run_command(self, words: list[str]) -> None:
        """`vehicle_roll_sim …`, in this process."""
        self._bring_own(words)
        self._has_run(*_printed_by(main, words))

    def _bring_own(self, words: list[str]) -> None:
        """Files that a reader has who is sent to a command that reads them."""
        before = ["", *words]
        for option, word in zip(before, words, strict=False):
            is_read = option not in OUTPUT_OPTIONS and "template" not in words
            if is_read and word in self._promised and not Path(word).exists():
                status, printed = _printed_by(main, self._promised.pop(word))
                assert status == 0, printed
            elif is_read and word.removeprefix("./") in self._own and not Path(word).exists():
                Path(word).write_text(self._own[word.removeprefix("./")], encoding="utf-8")

    def _run_script(self, words: list[str]) -> None:
        self._bring_own(words)
        if "vehicle_roll_sim.controller" in Path(words[0]).read_text(encoding="utf-8"):
            self._check_with_ros("check_script", *words)
            return
        with mock.patch.object(sys, "argv", words):
            self._has_run(*_printed_by(runpy.run_path, words[0], None, "__main__"))

    def _has_run(self, status, printed: str) -> None:
        self.count["run"] += 1
        self._printed += printed
        self._failed = self._failed or bool(status and not isinstance(status, dict))


def _printed_by(function, *given) -> tuple[object, str]:
    """What a function returns and prints."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        try:
            returned = function(*given)
        except SystemExit as ended:  # --help, or what a script finds
            returned = ended.code
    return returned, printed.getvalue()


def _commands_in(value) -> list[str]:
    """The lines of a job that call this package, or a script of the reader's."""
    if isinstance(value, str):
        return [value] if re.match(rf"(pip|{PACKAGE}|python) ", value) else []
    children = (
        value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    )
    return [command for child in children for command in _commands_in(child)]
