"""`python -m benchmarks` measures the requested parts and refuses unknown ones."""

import json
import math
import subprocess
import sys

import pytest
from patience import PATIENCE

MACHINE = ("CPU", "kernel", "Python", "numba", "numpy", "ROS", "vehicle_roll_sim")


@pytest.fixture
def benchmarks(root, tmp_path):
    """Runs the benchmarks with words and a file for the numbers."""

    def call(*words: str) -> subprocess.CompletedProcess:
        command = [sys.executable, "-m", "benchmarks", "--json", str(tmp_path / "numbers.json")]
        return subprocess.run(
            [*command, *words],
            cwd=root,
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            check=False,
        )

    return call


def test_the_model_is_measured_and_the_numbers_are_written_and_shown(benchmarks, tmp_path):
    result = benchmarks("--only", "kernel", "--quick")
    assert (result.returncode, result.stderr) == (0, "")
    written = json.loads((tmp_path / "numbers.json").read_text(encoding="utf-8"))
    assert set(written["machine"]) > {*MACHINE}
    assert written["quick"] is True
    assert list(written["results"]) == ["kernel"]
    rows = written["results"]["kernel"]
    assert len(rows) == 13
    for row in rows:
        assert f"| {row['what']} | {row['unit']} |" in result.stdout
        for key in ("median", "minimum", "calls"):
            assert 0.0 < row[key] < math.inf
        assert row["minimum"] <= row["median"]


@pytest.mark.parametrize("words", [("--only", "kernal"), ("--json", "/nowhere/numbers.json")])
def test_what_is_wrong_is_refused_in_one_line_before_anything_is_measured(benchmarks, words):
    result = benchmarks(*words)
    assert (result.returncode, result.stdout) == (2, "")
    assert result.stderr.count("\n") == 1
    assert result.stderr.startswith(f"benchmarks: error: {words[0]}: ")
