"""SIGINT and SIGTERM end every node with status 0 and no traceback, whatever it is doing."""

import gc
import itertools
import re
import signal
import sys
import threading
import time
from pathlib import Path

import pytest
import rclpy
from patience import PATIENCE
from rclpy import executors
from rclpy.context import Context
from rclpy.exceptions import NotInitializedException
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from recordings import heard_so_far, read_bag
from std_srvs.srv import Trigger

from vehicle_roll_sim.ros import node_main, signals
from vehicle_roll_sim.ros.node_main import NodeExecutor
from vehicle_roll_sim.ros.orchestration import demo

pytestmark = pytest.mark.unmeasured

SIGNALS = (signal.SIGINT, signal.SIGTERM)
WORDS = {"simulator": (), "manoeuvre": ("j_turn",), "recorder": ("--output", "{}/bag{}")}
EXAMPLES = Path(__file__).parents[2] / "msg_examples"
IMPORTING, IMPORTED, JOINING = "multiarray_umath", "rclpy_pybind", "librmw_fastrtps_cpp"
"""Libraries that a node reads in: at first, with rclpy, and when it joins the others."""
LONGEST_END = 10.0
"""s; seen: 0.25 to 0.6 on a quiet machine."""
TRIES = 3
"""Of which one must be quick: a busy machine may be slow at any time."""
LOOK = 0.001
"""s between two looks: the processor is left to the node."""
GAPS = (0.02, 0.1, 0.2)
"""s between two signals of somebody impatient."""


def wait_for_library(process, name: str) -> None:
    """Until a process has read in a library of that name."""
    until = time.monotonic() + PATIENCE
    maps = Path(f"/proc/{process.pid}/maps")
    while not re.search(name, maps.read_text()):
        assert process.poll() is None
        assert time.monotonic() < until, f"{name} is not read in"
        time.sleep(LOOK)


def ends_cleanly(begin, signum) -> str:
    """Send a signal to the node that `begin()` starts; what was printed. The end must be quick, in
    one of a few tries on a busy machine, and each with status 0 and no traceback."""
    for _ in range(TRIES):
        node = begin()
        sent = time.monotonic()
        status, out, err = node.finish(signum)
        took = time.monotonic() - sent
        assert (status, "Traceback" in out + err) == (0, False), err
        if took < LONGEST_END:
            return out
    raise AssertionError(f"it took {took:.1f} s to end, and too long before")


@pytest.mark.parametrize(
    ("moment", "signum"),
    [(IMPORTING, signal.SIGINT), (IMPORTED, signal.SIGTERM), (JOINING, signal.SIGINT)],
)
@pytest.mark.parametrize("module", WORDS)
def test_a_node_that_is_starting_ends_as_cleanly_as_one_that_runs(
    start, tmp_path, module, moment, signum
):
    tries = itertools.count()

    def starting():
        number = next(tries)
        node = start(module, *(word.format(tmp_path, number) for word in WORDS[module]), fresh=True)
        wait_for_library(node.process, moment)
        return node

    ends_cleanly(starting, signum)


@pytest.mark.parametrize(
    ("name", "moment", "signum"),
    [
        ("active_roll_bar", IMPORTED, signal.SIGINT),
        ("yaw_control", JOINING, signal.SIGTERM),
        ("rollover_warning", JOINING, signal.SIGTERM),
        ("roll_braking", IMPORTED, signal.SIGINT),
    ],
)
def test_a_controller_that_is_starting_ends_as_cleanly(start, name, moment, signum):
    """All end by the same lines of their base: every moment has two of them."""

    def starting():
        node = start("", program=str(EXAMPLES / f"{name}.py"), fresh=True)
        wait_for_library(node.process, moment)
        return node

    ends_cleanly(starting, signum)


@pytest.mark.parametrize("signum", SIGNALS)
def test_a_controller_that_answers_ends_as_cleanly(start, peer, signum):
    start("simulator")
    start("", program=str(EXAMPLES / "rollover_warning.py"))
    answers = {"normal_force_cmd": "active_roll_bar", "brake_torque_cmd": "roll_braking"}
    for topic, name in answers.items():

        def answering(topic=topic, name=name):
            node = start("", program=str(EXAMPLES / f"{name}.py"))
            peer.listen(topic)
            peer.newest(topic)
            return node

        ends_cleanly(answering, signum)


@pytest.mark.parametrize("signum", SIGNALS)
def test_a_recorder_closes_its_bag_and_a_manoeuvre_leaves_no_file(start, peer, tmp_path, signum):
    start("simulator")
    peer.listen("applied_command", "state")
    tries = itertools.count()

    def angle():
        return peer.newest("applied_command").data[1]

    def steering():
        assert peer.call(Trigger, "simulator/reset").success
        peer.wait(lambda: angle() == 0.0, "the end of what was commanded before")
        driver = start("manoeuvre", "j_turn", "--csv", str(tmp_path / "rows.csv"))
        peer.wait(lambda: angle() > 0.0, "the manoeuvre to steer")
        return driver

    def recording():
        bag = tmp_path / f"bag{next(tries)}"
        recorder = start("recorder", "--output", str(bag))
        peer.wait(lambda: "/state" in heard_so_far(bag), "the recorder to hear")
        enough = len(peer.received["state"]) + 100
        peer.wait(lambda: len(peer.received["state"]) > enough, "a second of driving")
        return recorder

    ends_cleanly(steering, signum)
    assert "messages in" in ends_cleanly(recording, signum)
    bag = max(tmp_path.glob("bag*"))
    assert len(read_bag(bag)["/state"]) > 50
    assert (bag / "metadata.yaml").exists()
    assert not list(tmp_path.glob("*.csv"))


def test_an_executor_that_is_cut_short_while_it_is_made_leaves_no_traceback(monkeypatch):
    lost = []
    monkeypatch.setattr(sys, "unraisablehook", lost.append)
    context = Context()
    rclpy.init(context=context)
    rclpy.shutdown(context=context)
    with pytest.raises((RuntimeError, NotInitializedException)):  # which a node's main heeds
        NodeExecutor(context=context)
    gc.collect()
    assert lost == []


def test_an_executor_is_made_whole_before_a_signal_shuts_its_context_down(domain, monkeypatch):
    lost, usual = [], executors.Clock
    monkeypatch.setattr(sys, "unraisablehook", lost.append)
    rclpy.init(args=[], domain_id=domain, signal_handler_options=SignalHandlerOptions.NO)
    signalled = threading.Thread(target=node_main._shut_down)

    def half_made(**about):
        signalled.start()
        signalled.join(GAPS[-1])  # time enough, were it not to wait
        return usual(**about)

    monkeypatch.setattr(executors, "Clock", half_made)
    with node_main.lifetime(Node("made")):
        signalled.join(PATIENCE)
    assert not rclpy.ok()
    gc.collect()
    assert lost == []


@pytest.mark.parametrize("signum", SIGNALS)
@pytest.mark.parametrize("module", ["simulator", "recorder"])
def test_a_second_signal_changes_nothing(start, peer, tmp_path, module, signum):
    def is_there():
        return module in peer.node.get_node_names()

    for number, gap in enumerate(GAPS):
        peer.wait(lambda: not is_there(), "the one before to be forgotten")
        node = start(module, *(word.format(tmp_path, number) for word in WORDS[module]))
        peer.wait(is_there, "the node")
        node.process.send_signal(signum)
        time.sleep(gap)  # what is tried
        status, _, err = node.finish(signum)
        assert (status, "Traceback" in err) == (0, False), err


@pytest.mark.parametrize("signum", SIGNALS)
def test_one_that_waits_for_an_answer_in_lockstep_ends_too(start, peer, signum):
    def waiting():
        simulator = start("simulator", "--ros-args", "-p", "mode:=lockstep")
        peer.listen("state")
        peer.publisher("steering_cmd")
        peer.wait(lambda: peer.received["state"], "the first set, which is not answered")
        return simulator

    ends_cleanly(waiting, signum)


@pytest.mark.parametrize(("status", "expected"), [(0, (0, "")), (130, (7, ""))])
def test_a_node_heeds_sigint_in_any_case_and_a_command_where_it_was_not_to_ignore_it(
    started, status, expected
):
    program = (
        "import signal, sys\n"
        "signal.signal(signal.SIGINT, signal.SIG_IGN)  # as whoever starts it would\n"
        "from vehicle_roll_sim import early_signals\n"
        f"early_signals.end_node_at_once({status}, even_ignored={not status})\n"
        "signal.raise_signal(signal.SIGINT)\n"
        "sys.exit(7)\n"
    )
    process = started([sys.executable, "-c", program], stderr=-1, text=True)
    _, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, err) == expected


def test_a_demo_that_was_started_to_ignore_hanging_up_does():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        assert signals.not_ignored(demo.ENDING) == [signal.SIGINT, signal.SIGTERM]
    finally:
        signal.signal(signal.SIGHUP, before)
