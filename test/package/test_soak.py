"""A short soak test: random messages, bursts, silence, resets and pauses violate no rule."""

import re
import subprocess
import sys

import pytest
from patience import PATIENCE

from benchmarks import soak

pytestmark = pytest.mark.unmeasured

MESSAGES = 8_000
"""Number of messages: about two seconds."""
GROWTH = 8.0
"""MiB: caches of the libraries still fill up in a run this short; a set a period is 20 MiB."""


def test_nothing_that_comes_in_breaks_a_promise_and_memory_does_not_grow(root):
    words = [sys.executable, "-m", "benchmarks.soak", "--messages", str(MESSAGES), "--seed", "1"]
    result = subprocess.run(
        words, cwd=root, capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert (result.returncode, result.stderr) == (0, "")
    told = dict(line.split(": ", 1) for line in result.stdout.splitlines())
    counts = re.fullmatch(r"(\d+), of which dropped (\d+), clamped (\d+)", told["messages"])
    taken, dropped, clamped = map(int, counts.groups())
    assert taken >= MESSAGES
    assert dropped > MESSAGES / 20
    assert clamped > MESSAGES / 200
    assert "diverged" in told["ends of runs"] or "rolled_over" in told["ends of runs"]
    assert float(told["memory growth (MiB)"]) < GROWTH


@pytest.mark.parametrize("words", [("--messages", "many"), ("--seed", "-1"), ("--sed", "1")])
def test_what_is_wrong_is_refused_in_one_line(capsys, words):
    assert soak.main([*words]) == 2
    result = capsys.readouterr()
    assert result.out == ""
    assert result.err.startswith("soak: error: ")
    assert result.err.count("\n") == 1
