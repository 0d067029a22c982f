"""`view --live` becomes the node that serves the page."""

import sys

import pytest

from vehicle_roll_sim.command_line import view_live
from vehicle_roll_sim.command_line.view import view_command
from vehicle_roll_sim.input_errors import InputError

NODE = [sys.executable, "-m", "vehicle_roll_sim.ros.executables", "live_view"]


@pytest.fixture
def started(monkeypatch):
    """started(*words): what the process would become."""
    commands = []
    monkeypatch.setattr(view_live.os, "execv", lambda _, words: commands.append(words))

    def call(*words):
        view_command(["--live", *words], "vehicle_roll_sim view")
        return commands.pop()

    return call


@pytest.mark.parametrize(
    ("words", "passed_on"),
    [
        ([], []),
        (["--port", "0", "--open"], ["--port", "0", "--open"]),
        (["--port", "x"], ["--port", "x"]),  # which the node refuses
        (["--namespace", "/car1/"], ["--ros-args", "-r", "__ns:=/car1"]),
    ],
)
def test_arguments_are_passed_on_to_the_node(started, words, passed_on):
    assert started(*words) == NODE + passed_on


def test_a_recorded_run_is_refused(started):
    with pytest.raises(InputError, match=r"unrecognized arguments: run\.csv"):
        started("run.csv")
