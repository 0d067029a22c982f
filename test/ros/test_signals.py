"""SIGINT and SIGTERM end every node with status 0 and no traceback, whatever it is doing."""

import re
import signal
import time
from pathlib import Path

import pytest
from peers import PATIENCE
from recordings import read_bag

SIGNALS = (signal.SIGINT, signal.SIGTERM)
WORDS = {"simulator": (), "manoeuvre": ("j_turn",), "recorder": ("--output", "{}/bag")}
IMPORTING, IMPORTED, JOINING = "multiarray_umath", "rclpy_pybind", "librmw_fastrtps_cpp"
"""Libraries that a node reads in: at first, with rclpy, and when it joins the others."""
LONGEST_END = 10.0
"""s: five times what is promised, for a machine that does much else at the same time."""


def wait_for_library(process, name: str) -> None:
    """Until a process has read in a library of that name."""
    until = time.monotonic() + PATIENCE
    maps = Path(f"/proc/{process.pid}/maps")
    while not re.search(name, maps.read_text()):
        assert process.poll() is None
        assert time.monotonic() < until, f"{name} is not read in"


def ends_cleanly(node, signum) -> str:
    """Send a signal; what was printed. The end must be quick, with status 0 and no traceback."""
    sent = time.monotonic()
    status, out, err = node.finish(signum)
    assert time.monotonic() - sent < LONGEST_END
    assert (status, "Traceback" in out + err) == (0, False), err
    return out


@pytest.mark.parametrize(
    ("moment", "signum"),
    [(IMPORTING, signal.SIGINT), (IMPORTED, signal.SIGTERM), (JOINING, signal.SIGINT)],
)
@pytest.mark.parametrize("module", WORDS)
def test_a_node_that_is_starting_ends_as_cleanly_as_one_that_runs(
    start, tmp_path, module, moment, signum
):
    node = start(module, *(word.format(tmp_path) for word in WORDS[module]))
    wait_for_library(node.process, moment)
    ends_cleanly(node, signum)


@pytest.mark.parametrize("signum", SIGNALS)
def test_a_recorder_closes_its_bag_and_a_manoeuvre_leaves_no_file(start, peer, tmp_path, signum):
    start("simulator")
    recorder = start("recorder", "--output", str(tmp_path / "bag"))
    peer.wait_for_listener("state", "recorder")
    peer.listen("applied_command")
    driver = start("manoeuvre", "j_turn", "--csv", str(tmp_path / "rows.csv"))
    peer.wait(lambda: peer.newest("applied_command").data[1] > 0.0, "the manoeuvre to steer")
    ends_cleanly(driver, signum)
    assert "messages in" in ends_cleanly(recorder, signum)
    assert len(read_bag(tmp_path / "bag")["/state"]) > 50
    assert (tmp_path / "bag" / "metadata.yaml").exists()
    assert not list(tmp_path.glob("*.csv"))


@pytest.mark.parametrize("signum", SIGNALS)
def test_one_that_waits_for_an_answer_in_lockstep_ends_too(start, peer, signum):
    simulator = start("simulator", "--ros-args", "-p", "mode:=lockstep")
    peer.listen("state")
    steering = peer.publisher("steering_cmd")
    peer.wait(lambda: peer.received["state"], "the first set, which is not answered")
    ends_cleanly(simulator, signum)
    assert steering is not None
