"""Pacing by the clock: faster, slower, as fast as possible; lateness and mismatches reported."""

import itertools
import os
import signal
import statistics
import time

import pytest
from peers import EVERY_STATE
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import Imu
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.messages.covariances import Covariances
from vehicle_roll_sim.messages.sets import Messages
from vehicle_roll_sim.ros.compatibility import incompatible_partners
from vehicle_roll_sim.ros.simulator.publications import Publications
from vehicle_roll_sim.ros.simulator.settings import LOCKSTEP, Settings

CHANGES_NO_MIND = """
import sys

import rclpy

from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.ros.simulator.node import Simulator

rclpy.init()
simulator = Simulator()
kernels = [
    kernel
    for name, module in list(sys.modules.items())
    if name.startswith("vehicle_roll_sim.model.") and jit.COMPILED
    for kernel in vars(module).values()
    if isinstance(getattr(kernel, "signatures", None), list)
]
compiled = lambda: sum(len(kernel.signatures) for kernel in kernels)
before = compiled()
simulator.begin()
for _, build in simulator._publications._set.values():
    build()
for _ in range(3):
    simulator.run_period()
print(len(kernels), before, compiled())
"""


def diagnostics_of(peer) -> dict[str, str]:
    return {value.key: value.value for value in peer.newest("/diagnostics").status[0].values}


def last(peer) -> float:
    """Simulated time of the newest state (s)."""
    return peer.received["state"][-1][1].data[0]


def seconds(stamp) -> float:
    return stamp.sec + 1e-9 * stamp.nanosec


@pytest.mark.parametrize("factor", [0.0, 0.5, 20.0])
def test_with_another_time_factor_stamps_are_simulated_time_and_the_clock_is_there(
    start, peer, factor
):
    start("simulator", "--ros-args", "-p", f"real_time_factor:={factor}")
    peer.listen("state", "imu", "/clock")
    peer.wait(lambda: peer.newest("state").data[0] > 0.2, "time to go on")
    simulated = peer.newest("state").data[0]

    def clock() -> float:
        return seconds(peer.newest("/clock").clock)

    peer.wait(lambda: clock() >= simulated, "the clock of that state")  # topics overtake each other
    assert clock() < simulated + 100.0  # s, not those since 1970
    stamp = seconds(peer.newest("imu").header.stamp)
    assert stamp == pytest.approx(round(stamp, 2), abs=1e-9)  # a whole number of periods


def test_in_real_time_there_is_no_clock_and_stamps_are_of_today(start, peer):
    start("simulator")
    peer.listen("imu")
    assert seconds(peer.newest("imu").header.stamp) > 1e9
    assert peer.node.count_publishers("/clock") == 0


def test_as_fast_as_possible_still_answers_and_pauses(start, peer):
    start("simulator", "--ros-args", "-p", "real_time_factor:=0.0")
    peer.listen("state")
    peer.wait(lambda: peer.newest("state").data[0] > 1.0, "time to go on")
    assert peer.call(Trigger, "simulator/reset").success
    assert peer.call(SetBool, "simulator/pause", SetBool.Request(data=True)).success
    stopped_at = float(peer.call(Trigger, "simulator/step").message.split()[0])
    assert float(peer.call(Trigger, "simulator/step").message.split()[0]) == pytest.approx(
        stopped_at + 0.01
    )


def test_a_model_that_has_stopped_is_not_published_faster_than_its_rate(start, peer):
    words = ("-p", "real_time_factor:=0.0", "-p", "publish_rate:=10.0", "-p", "step:=0.01")
    start("simulator", "--ros-args", *words, "-p", "command_timeout:=0.0")
    peer.listen("rollover", "state")

    def rolled_over():
        return peer.received["rollover"] and peer.received["rollover"][-1][1].data

    peer.command({"steering_cmd": 0.2}, rolled_over, "a rollover")
    sent = []
    while len(sent) < 20:
        peer.newest("state")
        sent = [stamp for stamp, state in peer.received["state"] if state.data[0] == last(peer)]
    intervals = [after - before for before, after in itertools.pairwise(sent)]
    # ns: half a period; on a busy machine one set may come late, and the next one soon after it
    assert statistics.median(intervals) > 0.05e9


def test_every_second_the_rate_is_in_the_diagnostics(start, peer):
    start("simulator", "--ros-args", "-p", "publish_rate:=200.0")
    peer.listen("/diagnostics")

    def some_rate_is_right():
        rate = float(diagnostics_of(peer)["publish rate (Hz)"])
        return rate == pytest.approx(200.0, rel=0.1)

    def some_interval_is_right():
        peer.newest("/diagnostics")
        sent = [stamp for stamp, _ in peer.received["/diagnostics"]]
        return any(0.5e9 < two[1] - two[0] < 1.6e9 for two in itertools.pairwise(sent))

    peer.wait(some_rate_is_right, "a rate near 200 Hz")
    peer.wait(some_interval_is_right, "two statuses a second apart")


def test_lateness_is_in_the_diagnostics_in_milliseconds(start, peer):
    simulator = start("simulator")
    peer.listen("/diagnostics")

    def late() -> list[float]:
        told = diagnostics_of(peer)
        names = ("lateness p50 (ms)", "lateness p99 (ms)", "largest lateness (ms)")
        return [float(told[name]) for name in names]

    late()
    simulator.process.send_signal(signal.SIGSTOP)
    time.sleep(0.3)  # the suspension itself is what is tried
    simulator.process.send_signal(signal.SIGCONT)
    median, most, largest = peer.wait(lambda: (found := late())[2] > 200.0 and found, "the delay")
    assert 0.0 <= median <= most <= largest < 10_000.0


def test_a_suspended_simulator_gives_up_what_is_beyond_its_catch_up_and_never_jumps(start, peer):
    words = ("-p", "catch_up_limit:=0.05", "-p", EVERY_STATE)
    simulator = start("simulator", "--ros-args", *words)
    peer.listen("state", "/diagnostics")
    peer.newest("state")
    before = int(diagnostics_of(peer)["overruns"])
    os.kill(simulator.process.pid, signal.SIGSTOP)
    time.sleep(1.0)  # the suspension itself is what is tried
    os.kill(simulator.process.pid, signal.SIGCONT)
    # 1 s less 0.05 s and the period that is due, in periods of 10 ms
    peer.wait(lambda: int(diagnostics_of(peer)["overruns"]) - before >= 93, "the overruns")
    assert "the machine is too slow" in peer.received["/diagnostics"][-1][1].status[0].message
    times = [state.data[0] for _, state in peer.received["state"]]
    steps = [after - before for before, after in itertools.pairwise(times)]
    assert steps == pytest.approx([0.01] * len(steps), abs=1e-9)


def test_partners_that_can_never_be_connected_are_told(start, peer):
    simulator = start("simulator")
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    peer.node.create_subscription(Imu, "imu", lambda _: None, latched)
    peer.node.create_publisher(String, "steering_cmd", 1)
    peer.node.create_publisher(Float64, "rear_steering_cmd", 1)  # this one fits
    peer.listen("/diagnostics")
    for _ in range(3):
        peer.newest("/diagnostics")
    _, _, err = simulator.finish(2)
    lines = [line for line in err.splitlines() if "WARN" in line]
    warnings = [line for line in lines if "the machine is too slow" not in line]
    assert any("/imu: the subscription of peer" in line for line in warnings)
    assert any(
        "/steering_cmd: the publisher of peer: published as std_msgs/msg/String" in w
        for w in warnings
    )
    assert len(warnings) == 2  # once each


def test_a_partner_whose_node_is_not_known_yet_is_left_to_the_next_look(make_peer, monkeypatch):
    peer, other = make_peer(), make_peer("/other")
    peer.node.create_subscription(Float64, "steering_cmd", lambda _: None, 1)
    other.node.create_publisher(String, "/steering_cmd", 1)
    peer.wait(lambda: incompatible_partners(peer.node), "the misfit")
    found = peer.node.get_publishers_info_by_topic("/steering_cmd")
    found[0].node_name = "_NODE_NAME_UNKNOWN_"
    monkeypatch.setattr(peer.node, "get_publishers_info_by_topic", lambda _: found)
    assert incompatible_partners(peer.node) == []


def test_what_nobody_listens_to_is_not_built(peer, monkeypatch):
    session = Session(Simulation(preset()), CommandInbox(), 10_000_000, 13.9)
    built = []
    for name in ("odom", "imu"):
        usual = getattr(Messages, name)
        monkeypatch.setattr(Messages, name, lambda m, n=name, u=usual: built.append(n) or u(m))
    publications = Publications(peer.node, session, Settings(mode=LOCKSTEP), Covariances())
    peer.listen("imu")
    peer.wait(lambda: publications.listeners("imu"), "the listener to be found")
    built.clear()
    publications.publish_set()
    assert built == ["imu"]
    peer.wait(lambda: peer.received["imu"], "the message")


def test_nothing_is_compiled_once_the_simulator_is_there(start, tmp_path):
    program = tmp_path / "program.py"
    program.write_text(CHANGES_NO_MIND)
    status, out, err = start("program", program=str(program), fresh=True).finish()
    assert status == 0, err
    kernels, before, after = map(int, out.split())
    assert kernels > 0
    assert before == after
