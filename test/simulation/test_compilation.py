"""The model is compiled once, even if waiting processes come and go."""

import fcntl
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE, wait_until

from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.model.compiled.code_cache import COMPLETE
from vehicle_roll_sim.model.compiled.jit import CACHE
from vehicle_roll_sim.simulation.compilation import COMPILING, LOCK, begin_compiling

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(CACHE is None, reason="only compiled code is cached"),
]
COMMAND = [sys.executable, "-m", "vehicle_roll_sim", "compile"]


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """A cache in which everything is, but that nobody has noted as complete."""
    folder = tmp_path / CACHE.name
    shutil.copytree(CACHE, folder, ignore=shutil.ignore_patterns(COMPLETE, LOCK))
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    return folder


@pytest.fixture
def start(started):
    """start(): the command `compile`, which ends with the test."""
    pipe = subprocess.PIPE
    return lambda: started(COMMAND, stdout=pipe, stderr=pipe, text=True)


def compiling_processes(folder: Path) -> list[Path]:
    """Processes, by their folders in /proc, that were started to fill this cache."""
    found = []
    for words in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if b"fill_cache" in (text := words.read_bytes()) and os.fsencode(folder) in text:
                found.append(words.parent)
        except OSError:  # it has just ended
            continue
    return found


def test_it_says_where_the_compiled_model_is(folder, start):
    out, err = start().communicate(timeout=PATIENCE)
    assert out == f"compiled model, cached in {folder}\n"
    assert err == f"{COMPILING}\n"
    assert (folder / COMPLETE).exists()
    out, err = start().communicate(timeout=PATIENCE)
    assert (out, err) == (f"compiled model, cached in {folder}\n", "")


def test_an_interrupted_command_leaves_the_compiling_to_go_on(folder, start):
    with (folder / LOCK).open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # as one that compiles for long
        first, second = start(), start()
        wait_until(lambda: len(compiling_processes(folder)) == 2, "two that compile")
        first.send_signal(signal.SIGINT)
        _, err = first.communicate(timeout=PATIENCE)
        assert first.returncode == 130
        assert err == f"{COMPILING}\nvehicle_roll_sim: interrupted\n"
        assert len(compiling_processes(folder)) == 2
        assert second.poll() is None
        assert not (folder / COMPLETE).exists()
    out, _ = second.communicate(timeout=PATIENCE)
    assert second.returncode == 0
    assert "cached in" in out
    wait_until(lambda: not compiling_processes(folder), "the end of the compiling")


def test_in_the_background_nobody_waits_and_the_second_finds_the_work_done(
    folder, monkeypatch, capsys
):
    monkeypatch.setattr(jit, "CACHE", folder)
    with (folder / LOCK).open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # as the first
        second = begin_compiling()
        assert capsys.readouterr().err == f"{COMPILING}\n"
        wait_until(lambda: compiling_processes(folder), "the second")
        (folder / COMPLETE).touch()
    assert second.wait(PATIENCE) == 0
    assert begin_compiling() is None
    assert capsys.readouterr().err == ""


def test_a_compiling_process_that_dies_keeps_nobody_waiting(folder, start):
    with (folder / LOCK).open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        command = start()
        (compiling,) = wait_until(lambda: compiling_processes(folder), "one that compiles")
        os.kill(int(compiling.name), signal.SIGKILL)
        out, _ = command.communicate(timeout=PATIENCE)
    assert command.returncode == 0
    assert "cached in" in out
