"""Programs that start nodes limit discovery to this machine unless the environment is set."""

import shutil
import subprocess
from pathlib import Path

import pytest

from vehicle_roll_sim.ros.orchestration import demo

ROOT = Path(__file__).parents[3]
DISCOVERY = "ROS_AUTOMATIC_DISCOVERY_RANGE"


def given_on_by_the_demo(monkeypatch) -> str:
    """The range of discovery that a node of the demonstration is started with."""
    environments = []
    monkeypatch.setattr(demo.subprocess, "Popen", lambda *_, env, **__: environments.append(env))
    demo.start("simulator")
    (environment,) = environments
    return environment[DISCOVERY]


def given_on_by_make(_) -> str:
    """That which a recipe of the Makefile has."""
    words = ["make", "--silent", "--eval", f"show: ; @echo $${DISCOVERY}", "show"]
    return subprocess.run(words, cwd=ROOT, capture_output=True, text=True).stdout.strip()


@pytest.mark.parametrize(
    "given_on",
    [
        given_on_by_the_demo,
        pytest.param(
            given_on_by_make,
            marks=pytest.mark.skipif(not shutil.which("make"), reason="no make on this system"),
        ),
    ],
)
def test_a_start_command_discovers_this_machine_alone_unless_told(monkeypatch, given_on):
    monkeypatch.delenv(DISCOVERY)
    assert given_on(monkeypatch) == "LOCALHOST"
    monkeypatch.setenv(DISCOVERY, "SUBNET")
    assert given_on(monkeypatch) == "SUBNET"
