"""Controllers as processes: any script, program or launch file; started, watched and ended."""

import contextlib
import dataclasses
import os
import shlex
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Sequence
from pathlib import Path

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.ros.controller_scripts import (
    assigned,
    commanded_by,
    examples,
    scripts_of,
    texts_of,
)
from vehicle_roll_sim.ros.orchestration.demo import LOCAL, PATIENCE
from vehicle_roll_sim.scoring.options import WARNING

LAUNCH_ENDINGS = (".launch.py", ".launch.xml", ".launch.yaml", ".launch.yml")
TOGETHER = "+"
"""Between controllers that form a chain."""
POLL = 0.02
"""s"""
ROS_ARGS = ["--ros-args"]


class ControllerFailedError(Exception):
    """A controller cannot be scored; the text says why, in one line."""


@dataclasses.dataclass(frozen=True)
class Controller:
    """What is scored as one.

    name: in the report. programs: the words of each process. answers: the topics on which it
    answers each set. files: whose content its results depend on.
    """

    name: str
    programs: tuple[tuple[str, ...], ...]
    answers: tuple[str, ...]
    files: tuple[Path, ...] = ()


def controller_of(
    text: str, parameters: Sequence[str], answers: Iterable[str], field: str
) -> Controller:
    """The controller that the user names; raises InputError naming `field`.

    text: the name of an example, the path of a controller script or of a launch file, or a command
    line; several of them, separated by +, form a chain. parameters: NAME:=VALUE for scripts.
    answers: topics of programs that do not tell them.
    """
    words = [each.strip() for each in f" {text} ".split(f" {TOGETHER} ")]
    if not all(words):
        raise InputError(field, text, f"names, scripts or commands, separated by {TOGETHER}")
    scripts = scripts_of(filter(_is_script, words), field)
    given = assigned(parameters, scripts, field) if scripts else {}
    if parameters and not scripts:
        raise InputError("--parameter", parameters[0], "together with a script; see --help")
    programs = [
        (sys.executable, str(each.resolve()), *(ROS_ARGS + given[each] if given[each] else []))
        for each in scripts
    ]
    programs += [_command(each, field) for each in words if not _is_script(each)]
    found = [*commanded_by(scripts, field), *_warning_of(scripts, field), *answers]
    if not found:
        raise InputError("--answers", None, f"the topics on which {text} answers each set")
    files = [Path(word) for words in programs for word in words if _is_own_file(word)]
    name = f" {TOGETHER} ".join(Path(each.split()[0]).name.split(".")[0] for each in words)
    return Controller(name, tuple(programs), tuple(dict.fromkeys(found)), tuple(files))


def _is_own_file(word: str) -> bool:
    return word != sys.executable and Path(word).is_file()


def _is_script(text: str) -> bool:
    """Whether it is an example or a Python script, which tell their answers."""
    return text in examples() or (text.endswith(".py") and not text.endswith(LAUNCH_ENDINGS))


def _warning_of(scripts: Sequence[Path], field: str) -> list[str]:
    return [WARNING] if any(WARNING in texts_of(each, field) for each in scripts) else []


def _command(text: str, field: str) -> tuple[str, ...]:
    """The words of a launch file or a command line; raises InputError if there is no program."""
    try:
        words = shlex.split(text)
    except ValueError as error:
        raise InputError(field, text, "a command line", str(error)) from None
    if words and words[0].endswith(LAUNCH_ENDINGS):
        if not Path(words[0]).is_file():
            raise InputError(field, words[0], "the path of a launch file")
        words = ["ros2", "launch", str(Path(words[0]).resolve()), *words[1:]]
    program = shutil.which(words[0]) if words else None
    if program is None:
        problem = f"there is no program {words[0]}" if words else ""
        allowed = "a script, a launch file, a command line, or one of " + ", ".join(examples())
        raise InputError(field, text, allowed, problem)
    return (program, *words[1:])


class Processes:
    """The processes of a controller; what they print goes to files in `folder`."""

    def __init__(self, controller: Controller, folder: Path):
        self._controller, self._folder = controller, folder
        self._running: list[tuple[str, subprocess.Popen, Path]] = []
        self._started = 0

    @property
    def are_running(self) -> bool:
        """Whether they have been started, and not stopped since."""
        return bool(self._running)

    def start(self) -> None:
        """Start one process for each program."""
        for words in self._controller.programs:
            self._started += 1
            file = self._folder / f"{self._started}.txt"
            with file.open("w") as said:
                process = subprocess.Popen(
                    list(words),
                    env=LOCAL | os.environ,
                    stdin=subprocess.DEVNULL,
                    stdout=said,
                    stderr=said,
                    start_new_session=True,
                )
            self._running.append((_name(words), process, file))

    def check(self) -> None:
        """Raise ControllerFailedError if one has ended."""
        for name, process, file in self._running:
            if process.poll() is not None:
                text = file.read_text(encoding="utf-8", errors="replace")
                last = text.split("\n") if text.strip() else ["no output"]
                line = next((each for each in reversed(last) if each.strip()), "no output")
                status = process.returncode
                raise ControllerFailedError(f"{name} ended with status {status}: {line.strip()}")

    def stop(self) -> None:
        """End all processes, and everything that they have started in their sessions."""
        for _, process, _ in self._running:
            _signal(process.pid, signal.SIGTERM)
        until = time.monotonic() + PATIENCE
        for _, process, _ in self._running:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(max(until - time.monotonic(), POLL))
            _signal(process.pid, signal.SIGKILL)
            process.wait()
        self._running.clear()


def _name(words: Sequence[str]) -> str:
    named = words[1] if words[0] == sys.executable and len(words) > 1 else words[0]
    return Path(named).name


def _signal(group: int, signum: int) -> None:
    """Send a signal to a process that leads a group, and to its group."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(group, signum)
