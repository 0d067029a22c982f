"""Nodes whose /clock is absent or runs backwards, or without a compiler or home folder."""

import re
from pathlib import Path

import pytest
from recordings import heard_so_far
from rosgraph_msgs.msg import Clock

from vehicle_roll_sim.model.compiled.jit import CACHE

pytestmark = pytest.mark.unmeasured

SIM_TIME = ("--ros-args", "-p", "use_sim_time:=true")
EXAMPLES = Path(__file__).parents[2] / "msg_examples"
ANSWERS = {
    "normal_force_cmd": "active_roll_bar",
    "rear_steering_cmd": "rear_steering",
    "brake_torque_cmd": "roll_braking",
}
SHORT = ("step_steer", "--duration", "1.5")
WITHOUT_NUMBA = """
import sys

sys.modules["numba"] = None
sys.argv[0] = "simulator"
from vehicle_roll_sim.ros.executables import simulator

sys.exit(simulator())
"""


def clock_at(seconds: float) -> Clock:
    clock = Clock()
    clock.clock.sec = int(seconds)
    return clock


@pytest.mark.parametrize("times", [(), (9.0, 8.0, 1.0)], ids=["absent", "back"])
def test_whoever_drives_or_records_goes_by_the_states_not_by_the_clock(
    start, peer, tmp_path, times
):
    """A clock that stands still or jumps back delays nothing and makes nothing run backwards."""
    start("simulator")
    bag = tmp_path / "bag"
    recorder = start("recorder", "--output", str(bag), "--duration", "60", *SIM_TIME)
    peer.wait(lambda: "/state" in heard_so_far(bag), "the recorder to hear")
    driver = start("manoeuvre", *SHORT, *SIM_TIME)
    publisher = peer.node.create_publisher(Clock, "/clock", 10)
    left = list(times)

    def told_and_over():
        if left and publisher.get_subscription_count():
            publisher.publish(clock_at(left.pop(0) if len(left) > 1 else left[0]))
        return driver.process.poll() is not None

    peer.wait(told_and_over, "the end of the manoeuvre")
    status, out, err = driver.finish()
    assert (status, err) == (0, "")
    (end,) = re.findall(r"end: +(\S+) s, complete", out)
    assert 1.5 <= float(end) < 60.0  # at 1.5 s, but for states that a busy machine loses
    status, out, _ = recorder.finish(2)
    assert status == 0
    assert int(out.splitlines()[-1].split()[1]) > 100  # messages


def test_controllers_answer_the_states_not_the_clock(start, peer):
    """While it is absent, goes on, back, and stands still, every controller answers."""
    start("simulator")
    for program in (*ANSWERS.values(), "rollover_warning"):
        start("", *SIM_TIME, program=str(EXAMPLES / f"{program}.py"))
    peer.listen(*ANSWERS)

    def wait_for_answers():
        for kept in peer.received.values():
            kept.clear()
        for name, kept in peer.received.items():
            peer.wait(lambda kept=kept: len(kept) > 20, f"answers: {name}")

    wait_for_answers()
    clock = peer.node.create_publisher(Clock, "/clock", 10)
    peer.wait(lambda: clock.get_subscription_count() > len(ANSWERS), "all controllers")
    for seconds in (9.0, 8.0, 1.0, 1.0):
        clock.publish(clock_at(seconds))
        wait_for_answers()


def test_a_simulator_without_numba_says_so_in_one_line_and_runs(start, peer, tmp_path):
    program = tmp_path / "simulator.py"
    program.write_text(WITHOUT_NUMBA)
    words = ("--ros-args", "-p", "publish_rate:=10.0", "-p", "step:=0.01")
    simulator = start("", *words, program=str(program), fresh=True)
    peer.listen("state")
    peer.wait(lambda: peer.newest("state").data[0] > 0.5, "time to go on")
    status, out, err = simulator.finish(2)
    assert status == 0
    (told,) = [line for line in (out + err).splitlines() if "numba is not installed" in line]
    assert "[WARN]" in told
    assert "install python3-numba" in told


@pytest.mark.parametrize("home", [None, "/proc/none"], ids=["missing", "not writable"])
def test_a_simulator_without_a_home_says_where_its_logs_are_and_runs(
    start, peer, monkeypatch, tmp_path, home
):
    """Under /proc nobody can make a folder, not even root."""
    for name in ("ROS_LOG_DIR", "ROS_HOME", "HOME"):
        monkeypatch.delenv(name, raising=False)
    if home:
        monkeypatch.setenv("HOME", home)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    if CACHE:
        monkeypatch.setenv("XDG_CACHE_HOME", str(CACHE.parents[1]))  # nothing to compile
    simulator = start("simulator")
    peer.listen("state")
    peer.newest("state")
    status, _, err = simulator.finish(2)
    assert status == 0
    (folder,) = tmp_path.glob("ros_log_*")
    assert [line for line in err.splitlines() if "log" in line] == [
        f"simulator: ~/.ros/log is not writable, logs are in {folder}"
    ]
    assert list(folder.iterdir())
