"""`vehicle_roll_sim study`: results, Ctrl-C, and what is refused."""

import math
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from vehicle_roll_sim import study
from vehicle_roll_sim.batch.case import Outcome
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.studies import chunks, cluster
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.study_file import study_of

ROOT = Path(__file__).parents[2]
TEXT = """\
manoeuvre: step_steer
fixed: {manoeuvre.duration: 0.2}
factors:
  vehicle.cg_height: [0.5, 0.6]
  manoeuvre.speed: [10, 20]
  options.model: ["1", 8dof]
chunk: 3
"""

STEEP = """\
manoeuvre: step_steer
factors: {road.bank: {distribution: normal, mean: 5, sd: 0.1}}
design: random
runs: 3
seed: 1
"""


@pytest.fixture
def file(folder):
    (folder / "turn.yaml").write_text(TEXT)
    return "turn.yaml"


@pytest.fixture
def interrupted_in_the_second_chunk(monkeypatch):
    """Runs have no metrics but `end_time`; Ctrl-C comes while the second chunk is computed."""
    calls = []

    def evaluate(cases, workers):
        calls.append(len(cases))
        if len(calls) == 2:
            raise KeyboardInterrupt
        metrics = dict.fromkeys(METRIC_UNITS, math.nan) | {"end_time": 0.2, "peak_roll": 0.1}
        return [Outcome(metrics, "", Condition.RUNNING, np.zeros(40)) for _ in cases]

    monkeypatch.setattr(chunks, "evaluate", evaluate)
    return calls


def test_the_command_and_the_function_give_the_same_rows_as_single_runs(command, file, folder):
    result = command("study", file, "--out", "turns", "--format", "csv")
    assert (result.status, result.err, result.value["results"]) == (0, "", "turns")
    found = study(file, "again", format="csv")
    assert (folder / "again/runs.csv").read_bytes() == (folder / "turns/runs.csv").read_bytes()
    assert len(found) == 8
    assert found["options.model"].tolist() == ["1", "8dof"] * 4
    single = command(
        *("run", "step_steer", "--duration", 0.2, "--speed", 20, "--set", "cg_height=0.6")
    )
    assert single.number("peak lateral acceleration") == pytest.approx(
        found["peak_lateral_acceleration"][6], abs=5e-4
    )
    shown = command("study", "--show", "turns")
    assert shown == result


def test_ctrl_c_says_what_is_done_and_the_same_command_continues(
    command, file, interrupted_in_the_second_chunk
):
    result = command("study", file, "--out", "turns", "--format", "csv")
    assert result.status == 130
    done, end = result.err.splitlines()
    assert done.startswith("vehicle_roll_sim: 3 runs are done; the same command continues")
    assert end == "vehicle_roll_sim: interrupted"
    assert command("study", file, "--out", "turns", "--format", "csv").status == 0
    assert interrupted_in_the_second_chunk == [3, 3, 3, 2]


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (["study"], "STUDY.yaml: missing: a study file and --out DIR, or --show DIR"),
        (["study", "turn.yaml"], "--out: missing"),
        (["study", "tern.yaml", "--out", "x"], "file tern.yaml: No such file or directory"),
        (["study", "turn.yaml", "--out", "x", "--format", "xls"], "--format: 'xls' is not allowed"),
        (["study", "turn.yaml", "--out", "turn.yaml"], "--out: turn.yaml: Not a directory"),
        (["study", "turn.yaml", "--out", "/proc/x", "--format", "csv"], "--out: /proc/x: "),
        (["study", "--show", "x", "--format", "csv"], "nothing but the folder of a study"),
        (["study", "--show", "nowhere"], "--show: 'nowhere' is not allowed: the folder of a study"),
        (
            ["study", "turn.yaml", "--out", "x", "--runs", "1"],
            "--runs: '1' is not allowed: together",
        ),
        (["study", "turn.yaml", "--out", "x", "--view", "x.pdf"], "--view: 'x.pdf' is not allowed"),
        (["study", "turn.yaml", "--out", "x", "--view", "y/x.html"], "y does not exist"),
        (
            ["study", "turn.yaml", "--out", "x", "--view", "x.html", "--runs", "1,-2"],
            "--runs: '1,-2' is not allowed: 1 to 30 whole numbers",
        ),
        (["study", "--show", "x", "--out", "y"], "nothing but the folder of a study"),
        (
            ["study", "turn.yaml", "--out", ".", "--format", "csv"],
            "--out: '.' is not allowed: a new",
        ),
    ],
)
def test_what_cannot_be_run_is_refused_in_one_line(command, file, words, problem):
    result = command(*words)
    assert result.status == 2
    assert result.err.count("\n") == 1
    assert problem in result.err


def test_a_study_whose_runs_are_all_refused_is_an_error(command, folder):
    (folder / "turn.yaml").write_text(STEEP)
    result = command("study", "turn.yaml", "--out", "turns", "--format", "csv")
    assert result.status == 2
    assert "turn.yaml: all 3 runs were refused: values with which runs can be made; one was " in (
        result.err
    )
    assert (folder / "turns" / "runs.csv").exists()


def test_without_pyarrow_it_says_what_to_install(command, file, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    result = command("study", file, "--out", "turns")
    assert result.status == 2
    assert "no Python package pyarrow: pip install pyarrow, or csv" in result.err


@pytest.mark.parametrize(
    ("address", "problem"),
    [
        ("127.0.0.1:9", "--dask: '127.0.0.1:9': no answer within 0.2 s: the address of a running"),
        ("cluster", "--dask: 'cluster': missing port number in address"),
        ("tls://here:80", "--dask: 'tls://here:80': TLS expects"),
        ("http://here:80", "--dask: 'http://here:80': unknown address scheme 'http'"),
    ],
)
def test_without_a_dask_scheduler_it_is_refused_in_one_line(
    command, file, folder, monkeypatch, address, problem
):
    pytest.importorskip("distributed", reason="distributed is not installed")
    monkeypatch.setattr(cluster, "PATIENCE", 0.2)
    result = command("study", file, "--out", "turns", "--format", "csv", "--dask", address)
    assert (result.status, result.err.count("\n")) == (2, 1)
    assert problem in result.err
    assert not (folder / "turns").exists()


def test_without_dask_it_says_what_to_install(command, file, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    result = command("study", file, "--out", "turns", "--format", "csv", "--dask", "here:8786")
    assert result.status == 2
    assert "--dask: no Python package distributed: pip install distributed, or" in result.err


def test_the_examples_are_studies_and_those_of_the_page(folder):
    page = (ROOT / "docs" / "studies.md").read_text(encoding="utf-8")
    paths = sorted((ROOT / "examples" / "studies").glob("*.yaml"))
    assert paths
    for path in paths:
        shutil.copy(path, folder)
        assert study_of(Source.of_file(path.name)).points > 0
        assert path.read_text(encoding="utf-8") in page, path.name
