"""Processes started by tests end with the test, even if it fails, and react to SIGINT."""

import ast
import shutil
import subprocess
import sys
from pathlib import Path

from patience import PATIENCE

HELPERS = {
    *("conftest.py", "forked.py", "peers.py", "launch_stand_in.py"),
    "test_study_on_dask.py",
}
"""Of which a fixture, or the helper itself, ends what they start."""
STARTING = {"Popen", "open_process"}


def calls_of(path: Path) -> set[str]:
    """The last names of all that a source calls."""
    calls = (n.func for n in ast.walk(ast.parse(path.read_text())) if isinstance(n, ast.Call))
    return {getattr(call, "attr", getattr(call, "id", "")) for call in calls}


def test_a_test_leaves_the_end_of_its_processes_to_a_fixture(root):
    found = {path for path in (root / "test").rglob("*.py") if STARTING & calls_of(path)}
    assert {path.name for path in found} == HELPERS


def test_a_fixture_ends_a_process_of_a_test_that_fails(root, tmp_path):
    text = """
import os, sys

def test_that_fails(started):
    process = started([sys.executable, "-c", "input()"], stdin=-1)
    print("pid", process.pid)
    assert False
"""
    (tmp_path / "test_it.py").write_text(text)
    for name in ("conftest.py", "collecting.py"):  # which it imports
        shutil.copy(root / "test" / name, tmp_path)
    words = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "test_it.py"]
    result = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=PATIENCE)
    assert result.returncode == 1
    (pid,) = (line.split()[1] for line in result.stdout.splitlines() if line.startswith("pid "))
    assert not Path(f"/proc/{pid}").exists()


def test_processes_of_tests_heed_sigint_where_the_tests_were_started_to_ignore_it(root):
    program = (
        "import signal, subprocess, sys\n"
        "signal.signal(signal.SIGINT, signal.SIG_IGN)\n"
        "sys.path.insert(0, 'test')\n"
        "import conftest\n"
        "own = 'import signal; print(signal.getsignal(signal.SIGINT) is signal.SIG_IGN)'\n"
        "signal.raise_signal(signal.SIGINT)\n"
        "subprocess.run([sys.executable, '-c', own], check=True)\n"
    )
    words = [sys.executable, "-c", program]
    result = subprocess.run(words, cwd=root, capture_output=True, text=True, timeout=PATIENCE)
    assert (result.returncode, result.stdout, result.stderr) == (0, "False\n", "")
