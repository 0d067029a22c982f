"""Long runs: a progress bar on a terminal only, and interruption by Ctrl-C."""

import fcntl
import functools
import os
import struct
import sys
import termios

import pytest
from tqdm import tqdm

from vehicle_roll_sim.command_line import run as run_module

RUN = ("run", "step_steer", "--duration", "20", "--sample", "1", "--amplitude", "1")
BAR = "s simulated"
LAST = "<end of what was shown>"
ROWS_AND_COLUMNS = struct.pack("HHHH", 24, 80, 0, 0)
"""Of the pseudo terminal, in the form that the system wants."""


@pytest.fixture
def at_terminal(command, monkeypatch):
    """Runs a command whose stderr is a pseudo terminal; returns what is shown there."""
    reading, writing = os.openpty()
    fcntl.ioctl(writing, termios.TIOCSWINSZ, ROWS_AND_COLUMNS)
    stderr = os.fdopen(writing, "w", encoding="utf-8")

    def call(*words) -> str:
        monkeypatch.setattr(sys, "stderr", stderr)
        result = command(*words)
        assert result.status == 0
        assert BAR not in result.out
        stderr.write(LAST)
        stderr.flush()
        shown = b""
        while not shown.endswith(LAST.encode()):  # a terminal passes on what it gets bit by bit
            shown += os.read(reading, 65536)
        return shown.decode().removesuffix(LAST)

    yield call
    stderr.close()
    os.close(reading)


@pytest.fixture
def long_run(monkeypatch):
    """Every run counts as one that has taken more than a second, and every step is shown."""
    at_once = functools.partial(tqdm, mininterval=0.0, miniters=1)
    monkeypatch.setattr(run_module, "tqdm", lambda **about: at_once(**(about | {"delay": 0.0})))


def test_a_long_run_shows_at_a_terminal_how_far_it_is(at_terminal, long_run):
    shown = at_terminal(*RUN)
    for part in ("0.0/20.0 s simulated", "10.0/20.0 s simulated", "50%"):
        assert part in shown
    assert shown.rsplit("\r", 2)[-2].strip() == ""  # the bar is wiped away at the end


def test_a_short_run_shows_nothing_at_a_terminal(at_terminal):
    assert at_terminal("run", "step_steer", "--duration", "0.1") == ""


def test_a_long_run_shows_nothing_where_there_is_no_terminal(command, long_run):
    result = command(*RUN)
    assert (result.status, result.err) == (0, "")
    assert BAR not in result.out


def interrupt(*_args, **_kwargs):
    raise KeyboardInterrupt


@pytest.mark.parametrize(
    "where",
    [
        "vehicle_roll_sim.simulation.simulation.Simulation.step",
        "vehicle_roll_sim.command_line.run.chosen_simulation",
        "vehicle_roll_sim.analysis.plots.plot_run",
        "pathlib.Path.replace",
    ],
)
def test_ctrl_c_ends_with_status_130_without_a_traceback_or_a_file(
    command, folder, monkeypatch, where
):
    monkeypatch.setattr(where, interrupt)
    result = command("run", "step_steer", "--duration", "0.1", "--plot", "figure.svg")
    assert result.status == 130
    assert result.err == "vehicle_roll_sim: interrupted\n"
    assert not any(folder.iterdir())
