"""Lockstep runs with and without controllers, each node in its own process, and their results."""

import contextlib
import dataclasses
import math
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.arguments import REFUSED as FAILED
from vehicle_roll_sim.arguments import WRONG_INPUT
from vehicle_roll_sim.manoeuvres.criteria import two_wheel_lift
from vehicle_roll_sim.ros.orchestration.demo import ENDING, LOCAL, POLL, start, stop
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import load_transfer_ratio
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_ANGLE

INNER_WHEELS_OFF = 0.999
"""Load transfer ratio: 1, less a margin for rounding."""
WARNED = re.compile(r"at (\d+\.\d+) s: the (\w+) wheels lift")
TRACEBACK = "Traceback (most recent call last)"


class RunFailedError(Exception):
    """A node ended before the run was over; the text says in one line which one and why.

    status: exit status for the program that drove the run: 2 if the node was given wrong input.
    """

    def __init__(self, text: str, status: int):
        super().__init__(text)
        self.status = status


@dataclasses.dataclass(frozen=True)
class Scenario:
    """The run: arguments of `manoeuvre`, the topics that it commands, and NAME:=VALUE parameters
    of the simulator."""

    manoeuvre: tuple[str, ...]
    commands: tuple[str, ...] = ("steering_cmd",)
    simulator: tuple[str, ...] = ()

    @property
    def rollover_angle(self) -> float:
        """Roll angle (rad) that counts as a rollover."""
        given = dict(each.split(":=", 1) for each in self.simulator)
        return float(given.get("rollover_angle", DEFAULT_ROLLOVER_ANGLE))


@dataclasses.dataclass(frozen=True)
class Chain:
    """Controllers that publish `commands`; each of `programs` is a script and its arguments."""

    commands: tuple[str, ...] = ()
    programs: tuple[tuple[str, ...], ...] = ()


NONE = Chain()


@dataclasses.dataclass(frozen=True)
class Outcome:
    """The result of a run. warnings: time (s) and side of each warning of wheel lift."""

    history: History
    warnings: tuple[tuple[float, str], ...] = ()
    rollover_angle: float = DEFAULT_ROLLOVER_ANGLE

    @property
    def peak_roll(self) -> float:
        """Largest absolute roll angle (deg)."""
        return float(np.degrees(np.abs(self.history["roll"]).max()))

    @property
    def ratios(self) -> np.ndarray:
        """Load transfer ratio of every sample, shape (n,)."""
        return load_transfer_ratio(self.history.wheels("normal_force"))

    @property
    def largest_ratio(self) -> float:
        """Largest absolute load transfer ratio."""
        return float(np.abs(self.ratios).max())

    @property
    def inner_wheels_off(self) -> float:
        """When both inner wheels are first unloaded (s), nan if never."""
        off = np.flatnonzero(np.abs(self.ratios) >= INNER_WHEELS_OFF)
        return float(self.history["time"][off[0]]) if len(off) else math.nan

    @property
    def warned(self) -> float:
        """Time (s) of the first warning about the side that lifts, nan if there is none."""
        off = self.history["time"] == self.inner_wheels_off
        side = "left" if (self.ratios[off] > 0.0).all() else "right"
        return min((time for time, warned in self.warnings if warned == side), default=math.nan)

    @property
    def two_wheel_lift(self) -> float:
        """Time (s) of the two-wheel lift, nan if there is none."""
        return two_wheel_lift(self.history)

    @property
    def rollover(self) -> float:
        """Time (s) of the rollover, nan if there is none."""
        over = np.abs(self.history["roll"]) >= self.rollover_angle
        return float(self.history["time"][over.argmax()]) if over.any() else math.nan

    @property
    def end(self) -> float:
        """Time (s) of the last sample."""
        return float(self.history["time"][-1])

    def at(self, name: str, time):
        """A signal at a time or an array of times (s), interpolated linearly."""
        return np.interp(time, self.history["time"], self.history[name])


def distance(without: Outcome, found: Outcome, end: float) -> float:
    """Largest distance (m) between the two vehicles at the same time, up to `end` (s)."""
    times = without.history["time"]
    times = times[times <= end]
    x, y = (found.at(name, times) - without.at(name, times) for name in ("x", "y"))
    return float(np.hypot(x, y).max())


def drive(scenario: Scenario, chain: Chain = NONE) -> Outcome:
    """Run simulator, manoeuvre and controllers as processes in lockstep, in our own ROS domain.

    No process outlives the call. Raises RunFailedError if a node ends too early, and
    KeyboardInterrupt after a signal.
    """
    topics = ", ".join(dict.fromkeys((*scenario.commands, *chain.commands)))
    parameters = ("mode:=lockstep", f"lockstep_topics:=[{topics}]", *scenario.simulator)
    with tempfile.TemporaryDirectory() as folder, noted_signals() as interrupted:
        rows, nodes = Path(folder) / "rows.csv", _Nodes(Path(folder))
        try:
            nodes.start("simulator", lambda **to: start("simulator", *ros_words(parameters), **to))
            for script, *words in chain.programs:
                nodes.start(Path(script).name, _starter(script, words))
            words = (*scenario.manoeuvre, "--csv", str(rows), "--with-commands")
            nodes.start("manoeuvre", lambda **to: start("manoeuvre", *words, **to))
            nodes.wait_for_last(interrupted)
        finally:
            nodes.stop()
        if interrupted.is_set():
            raise KeyboardInterrupt
        warnings = tuple((float(time), side) for time, side in WARNED.findall(nodes.said()))
        return Outcome(History.read_csv(rows), warnings, scenario.rollover_angle)


def ros_words(parameters: Sequence[str]) -> list[str]:
    """Command-line arguments for NAME:=VALUE parameters."""
    return ["--ros-args", *(word for each in parameters for word in ("-p", each))]


def _starter(script: str, words: Sequence[str]):
    """A function that starts a controller script in its own session, out of reach of Ctrl-C."""
    command = [sys.executable, script, *words]
    return lambda **to: subprocess.Popen(
        command, env=LOCAL | os.environ, start_new_session=True, **to
    )


@contextlib.contextmanager
def noted_signals() -> Iterator[threading.Event]:
    """Within the block, signals only set an event, so that no process is started and then lost."""
    interrupted = threading.Event()
    before = {each: signal.signal(each, lambda *_: interrupted.set()) for each in ENDING}
    try:
        yield interrupted
    finally:
        for signum, handler in before.items():
            signal.signal(signum, handler)


class _Nodes:
    """Processes by name; the stderr of each goes to a file in `folder`."""

    def __init__(self, folder: Path):
        self._folder, self._started = folder, []

    def start(self, name: str, starter) -> None:
        file = self._folder / f"{len(self._started)}.txt"
        with file.open("w") as said:
            process = starter(stdout=subprocess.DEVNULL, stderr=said)
        self._started.append((name, process, file))

    def stop(self) -> None:
        for _, process, _ in reversed(self._started):
            stop(process)

    def wait_for_last(self, interrupted: threading.Event) -> None:
        """Wait until the last process started has ended, or until a signal arrives.

        Raises RunFailedError if it fails, or if an earlier process ends before it.
        """
        *others, last = self._started
        while last[1].poll() is None:
            if interrupted.wait(POLL):
                return
            for each in others:
                if each[1].poll() is not None:
                    self._fail(each)
        if last[1].returncode:
            self._fail(last)

    def _fail(self, node: tuple) -> None:
        name, process, file = node
        text = _text_of(file)
        if TRACEBACK in text:
            print(text, file=sys.stderr, end="")  # from the user's script
        line = (text.splitlines() or ["no output"])[-1]
        if process.returncode == WRONG_INPUT:
            raise RunFailedError(f"{name}: {line.partition('error: ')[2] or line}", WRONG_INPUT)
        raise RunFailedError(f"{name} ended with status {process.returncode}: {line}", FAILED)

    def said(self) -> str:
        """The stderr of all processes."""
        return "".join(_text_of(file) for *_, file in self._started)


def _text_of(file: Path) -> str:
    return file.read_text(encoding="utf-8", errors="replace")
