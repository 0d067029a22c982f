"""SIGINT in the first second of a command: one line and status 130, never a traceback."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from patience import PATIENCE

pytestmark = pytest.mark.unmeasured

INTERRUPTED = (130, "vehicle_roll_sim: interrupted\n")
COMMAND = (sys.executable, "-m", "vehicle_roll_sim")
SCRIPT = (
    "import sys; from importlib.metadata import entry_points;"
    "(found,) = entry_points(group='console_scripts', name='vehicle_roll_sim');"
    "sys.exit(found.load()())"
)
"""What the scripts installed by pip and colcon do."""
WORDS = {
    "run": ("j_turn", "--csv", "rows.csv", "--plot", "figure.png", "--bag", "bag"),
    "series": ("sine_with_dwell", "--csv", "rows.csv"),
    "linearize": ("--npz", "model.npz"),
}
DELAYS = {
    "run": (0.0, 0.1, 0.3, 0.5, 0.7, 0.9),
    "series": (0.05, 0.2, 0.4),
    "linearize": (0.02, 0.15, 0.6),
}
"""Delays (s) after the handlers are installed: during imports, loading of code, and the run."""
FIRST_LIBRARY = "multiarray_umath"
"""A module of numpy, which all larger imports need."""


def handles_signals(pid: int) -> bool:
    """Whether a process has a SIGTERM handler, which Python alone does not install."""
    status = Path(f"/proc/{pid}/status").read_text()
    (caught,) = (line.split()[1] for line in status.splitlines() if line.startswith("SigCgt:"))
    return bool(int(caught, 16) >> (signal.SIGTERM - 1) & 1)


def wait_for_handlers(process: subprocess.Popen) -> None:
    """Wait until a process has its handlers; this must be before any large import."""
    until = time.monotonic() + PATIENCE
    while process.poll() is None:
        is_late = FIRST_LIBRARY in Path(f"/proc/{process.pid}/maps").read_text()
        if handles_signals(process.pid):
            return
        assert not is_late, "a library is read in under Python's own handler"
        assert time.monotonic() < until, "no handler of its own"


@pytest.fixture
def interrupted(started):
    """interrupted(command, folder, delay): exit status and stderr of a command that gets SIGINT so
    long after it has its handlers (s)."""
    pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}

    def ending(command, folder: Path, delay: float) -> tuple[int, str]:
        process = started(command, cwd=folder, **pipes)
        wait_for_handlers(process)
        time.sleep(delay)  # what is tried
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=PATIENCE)
        return process.returncode, err

    return ending


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="handlers are seen on Linux")
@pytest.mark.parametrize("name", WORDS)
def test_a_command_that_is_starting_is_interrupted_in_one_line(interrupted, tmp_path, name):
    for number, delay in enumerate(DELAYS[name]):
        folder = tmp_path / str(number)
        folder.mkdir()
        begin = (sys.executable, "-c", SCRIPT) if number % 2 else COMMAND
        ended = interrupted([*begin, name, *WORDS[name]], folder, delay)
        assert ended in (INTERRUPTED, (0, "")), delay
        assert not [path for path in folder.iterdir() if path.name not in WORDS[name]], delay


def test_a_command_that_was_started_to_ignore_sigint_does(started):
    """Like a background job of a shell script: Ctrl-C is meant for the foreground."""

    def ignore() -> None:
        signal.signal(signal.SIGINT, signal.SIG_IGN)

    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    process = started([*COMMAND, "run", "step_steer"], preexec_fn=ignore, **pipes)
    while process.poll() is None:
        process.send_signal(signal.SIGINT)
        time.sleep(0.01)
    _, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, err) == (0, "")
