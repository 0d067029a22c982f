"""Runs the command in this process, in an empty folder."""

import csv
import dataclasses
import json
import re
from pathlib import Path

import numpy as np
import pytest

from vehicle_roll_sim.command_line.main import main

DATA = re.compile(r'<script type="application/json" id="data">(.*?)</script>', re.DOTALL)
"""What a page of the viewer has of its runs."""


@dataclasses.dataclass(frozen=True)
class Result:
    """What a command left: its exit status and what it printed."""

    status: int
    out: str
    err: str

    @property
    def value(self) -> dict[str, str]:
        """The lines `label: value` that were printed."""
        pairs = (text.partition(":") for text in self.out.splitlines())
        return {label: value.strip() for label, _, value in pairs}

    def number(self, label: str) -> float:
        """The first number behind a label."""
        return float(self.value[label].split()[0])


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """The empty folder that a command is run in."""
    working = tmp_path / "working"
    working.mkdir()
    monkeypatch.chdir(working)
    return working


@pytest.fixture
def command(folder, capsys):
    """Runs `vehicle_roll_sim` with the given words."""

    def call(*words) -> Result:
        status = main([str(word) for word in words])
        printed = capsys.readouterr()
        return Result(status, printed.out, printed.err)

    return call


@pytest.fixture
def data(folder):
    """data(name): what a page has of its runs."""

    def read(name: str) -> dict:
        (found,) = DATA.findall((folder / name).read_text(encoding="utf-8"))
        return json.loads(found)

    return read


@pytest.fixture
def rows(command, folder):
    """Runs `run` with the given words and reads the columns of its CSV file."""

    def call(*words) -> dict[str, np.ndarray]:
        result = command("run", *words, "--csv", "rows.csv")
        assert (result.status, result.err) == (0, "")
        with (folder / "rows.csv").open(newline="") as file:
            read = list(csv.DictReader(file))
        return {name: np.array([float(row[name]) for row in read]) for name in read[0]}

    return call


@pytest.fixture
def refused(command, folder):
    """Runs a command that must end with status 2, one line that has all words, and no file."""

    def call(words, *expected) -> str:
        before = sorted(folder.rglob("*"))
        result = command(*words)
        assert (result.status, result.out) == (2, "")
        assert len(result.err.splitlines()) == 1
        assert result.err.startswith("vehicle_roll_sim")
        for word in expected:
            assert word in result.err
        assert sorted(folder.rglob("*")) == before
        return result.err

    return call
