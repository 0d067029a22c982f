"""Without numba every command that runs the model says so, once, on stderr; the others do not.

The model stays compiled here but for one run in another process: it would take minutes.
"""

import subprocess
import sys

import pytest
from patience import PATIENCE

from vehicle_roll_sim.model.compiled import jit

TOO_NEW = "Numba needs NumPy 2.4 or less. Got NumPy 2.5.\nSee its documentation."
SHORT = ("--start", "0", "--duration", "0.02")
RUN = """
import sys

{}
from vehicle_roll_sim.command_line.main import main

sys.exit(main(["run", "step_steer", *{}]))
"""
MISSING = 'sys.modules["numba"] = None'
BROKEN = f"""
class Broken:
    def find_spec(self, name, path=None, target=None):
        if name == "numba":
            raise ImportError({TOO_NEW!r})

sys.meta_path.insert(0, Broken())
"""
MOVED = "import numba.core.codegen as part; del part.JITCodeLibrary"


@pytest.fixture
def no_numba(monkeypatch):
    monkeypatch.setattr(jit, "numba", None)
    monkeypatch.setattr(jit, "NOT_USED", "is not installed", raising=False)


def reason_in(err: str) -> str:
    """The only line on stderr."""
    (told,) = err.splitlines()
    assert told.startswith("vehicle_roll_sim: numba is not installed: ")
    assert "slower" in told
    assert "python3-numba" in told
    return told


@pytest.mark.usefixtures("no_numba")
@pytest.mark.parametrize(
    "words",
    [
        ("run", "step_steer", *SHORT),
        ("series", "sine_with_dwell"),
        ("linearize",),
    ],
    ids=lambda words: words[0],
)
def test_a_command_that_runs_the_model_says_it_once(command, words):
    result = command(*words)
    assert result.status == 0
    reason_in(result.err)


@pytest.mark.usefixtures("no_numba")
@pytest.mark.parametrize("told", [(), ("--model", "1")], ids=["by the bag", "also by options"])
def test_a_replay_says_it_once(command, told):
    pytest.importorskip("rosbags", reason="bags need the library rosbags")
    reason_in(command("run", "step_steer", *SHORT, "--bag", "bag").err)
    result = command("replay", "bag", *told)
    assert result.status == 0
    reason_in(result.err)


@pytest.mark.usefixtures("no_numba")
def test_a_command_that_does_not_run_the_model_says_nothing(command, capsys):
    assert command("parameters").err == ""
    command("run", "step_steer", *SHORT, "--csv", "run.csv")
    assert command("plot", "run.csv").err == ""
    for word in ("--help", "--version"):
        with pytest.raises(SystemExit):
            command(*(["run", word] if word == "--help" else [word]))
        assert capsys.readouterr().err == ""


@pytest.mark.usefixtures("no_numba")
def test_wrong_usage_is_refused_in_one_line_all_the_same(refused):
    refused(("run", "step_steer", "--duratoin", "1"), "--duration")


@pytest.mark.unmeasured
@pytest.mark.parametrize(
    ("how", "reason"),
    [
        (MISSING, "numba is not installed"),
        (BROKEN, "numba cannot be imported (Numba needs NumPy 2.4 or less. Got NumPy 2.5.)"),
        (MOVED, "numba cannot be imported (cannot import name 'JITCodeLibrary'"),
    ],
    ids=["missing", "for another numpy", "with other inner parts"],
)
def test_where_it_is_missing_or_does_not_fit_the_run_comes_to_its_end(tmp_path, how, reason):
    words = [sys.executable, "-c", RUN.format(how, SHORT)]
    result = subprocess.run(
        words, cwd=tmp_path, capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert result.returncode == 0
    assert "0.020 s, complete" in result.stdout
    (told,) = result.stderr.splitlines()
    assert told.startswith(f"vehicle_roll_sim: {reason}")
