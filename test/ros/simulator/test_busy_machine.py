"""Floods, a suspended machine, a thousand resets: the simulator keeps working."""

import itertools
import signal
import statistics
import time
from bisect import bisect
from pathlib import Path

import pytest
from peers import EVERY_STATE, message_of
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import serialize_message
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim import Command, Simulation, preset
from vehicle_roll_sim.live.pacing import DEFAULT_CATCH_UP
from vehicle_roll_sim.messages.command_topics import COMMANDS
from vehicle_roll_sim.ros.topics import message_class

pytestmark = pytest.mark.unmeasured

NOT_OF_WHEELS = {
    **dict.fromkeys(("steering_cmd", "rear_steering_cmd", "drive_torque_cmd", "brake_cmd"), 0.0),
    "speed_cmd": 13.0,
    "wind_cmd": [0.0, 0.0],
    **dict.fromkeys(("road_height_cmd", "road_friction_cmd"), [1.0] * 4),
}
FLOOD = 4.0
"""s"""
BURST = 20
"""Messages on every topic between two looks at what comes back; they steer alike."""
NUMBERED = 1e-6
"""rad by which each burst steers more than the one before."""
OUTDATED = 25
"""Bursts, where two is usual: a queue of a thousand messages has 50."""
WARM_UP = 2.0
"""s in which buffers get their size."""
GROWTH = 5.0 / 60.0
"""MB/s; a tenth of the messages that the simulator takes in a flood is some 0.15 MB/s."""
GROWTH_OF_RESETS = 1.0
"""MB; 4 kB each would be 3.6."""
RATE_ERROR = 0.05
STANDSTILL = 1.5
"""s"""
RESETS = 1000
NS = 1e-9


def memory(process) -> float:
    """MB that are a process's own."""
    status = Path(f"/proc/{process.pid}/status").read_text()
    return int(status.partition("RssAnon:")[2].split()[0]) / 1024


def overruns(peer) -> int:
    """Periods that were given up so far, as the diagnostics have it."""
    values = peer.newest("/diagnostics").status[0].values
    return int(next(value.value for value in values if value.key == "overruns"))


def encoded(name: str, value) -> bytes:
    return serialize_message(message_of(name, value))


def sent_within(peer, name: str, began: int, ended: int) -> list:
    """What was sent on a topic from one moment (ns) to another, also if it is still to be heard."""
    peer.wait(lambda: peer.received[name][-1][0] > ended, f"what was sent on {name}")
    return [(sent, message) for sent, message in peer.received[name] if began <= sent <= ended]


@pytest.fixture
def flood(peer):
    """flood(seconds): every command as often as this process can, some 10 000 times a second.

    Returns when every burst so far was sent (ns).
    """
    usual = {
        topic.name: encoded(topic.name, NOT_OF_WHEELS.get(topic.name, [0.0] * 4))
        for topic in COMMANDS
    }
    bursts = []

    def publish(seconds):
        publishers = {name: peer.publisher(name) for name in usual}
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            usual["steering_cmd"] = encoded("steering_cmd", NUMBERED * len(bursts))
            bursts.append(time.time_ns())
            for name, publisher in list(publishers.items()) * BURST:
                publisher.publish(usual[name])
            peer.executor.spin_once(timeout_sec=0.0)
        return bursts

    return publish


def test_in_a_flood_of_commands_the_newest_wins_and_rate_and_memory_stay(start, peer, flood):
    simulator = start("simulator")
    peer.listen("state", "applied_command")
    flood(WARM_UP)
    for _ in range(2):  # once more where the machine was busy
        before, began = memory(simulator.process), time.time_ns()
        bursts, ended = flood(FLOOD), time.time_ns()
        assert memory(simulator.process) - before < GROWTH * FLOOD
        sets = sent_within(peer, "state", began, ended)
        part = len(sets) * 0.01 / (NS * (ended - began))
        if part > 1.0 - RATE_ERROR:
            break
    assert part == pytest.approx(1.0, abs=RATE_ERROR)
    behind = [
        bisect(bursts, sent) - 1 - round(applied.data[1] / NUMBERED)
        for sent, applied in sent_within(peer, "applied_command", began, ended)
    ]
    assert statistics.median(behind) < OUTDATED


@pytest.mark.parametrize("reliability", [ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT])
def test_a_publisher_of_either_reliability_commands_and_who_is_late_gets_what_is_latched(
    start, peer, make_peer, reliability
):
    start("simulator")
    peer.listen("applied_command")
    kind = message_class("std_msgs/msg/Float64")
    steering = peer.node.create_publisher(
        kind, "steering_cmd", QoSProfile(depth=1, reliability=reliability)
    )

    def steered():
        steering.publish(kind(data=0.01))
        return peer.newest("applied_command").data[1] == 0.01

    peer.wait(steered, "the command to be applied")
    late = make_peer()
    latched = ("rollover", "robot_description", "simulation_description")
    late.listen(*latched)
    late.wait(lambda: all(late.received[name] for name in latched), "what is latched")


def test_after_a_standstill_of_the_machine_time_does_not_jump(start, peer):
    """What is missed is counted, but for the 0.1 s that are caught up; time does not go by it."""
    simulator = start("simulator", "--ros-args", "-p", EVERY_STATE)
    peer.listen("state", "/diagnostics")
    peer.newest("state")
    before = overruns(peer)
    simulator.process.send_signal(signal.SIGSTOP)
    try:
        time.sleep(STANDSTILL)
    finally:
        resumed = time.time_ns()
        simulator.process.send_signal(signal.SIGCONT)
    for name in ("state", "/diagnostics"):
        peer.wait(lambda name=name: peer.received[name][-1][0] > resumed, f"{name} after it")
    peer.wait(lambda: overruns(peer) > before, "the missed periods to be counted")
    states = [(sent * NS, state.data[0]) for sent, state in peer.received["state"]]
    steps = [after - before for (_, before), (_, after) in itertools.pairwise(states)]
    assert steps == pytest.approx([0.01] * len(steps), abs=1e-9)
    (gone, then), (back, _) = max(itertools.pairwise(states), key=lambda two: two[1][0] - two[0][0])
    assert back - gone > 0.9 * STANDSTILL
    for sent, simulated in states:  # never further ahead than the clock and what is caught up
        if sent > gone:
            ahead = simulated - then - max(sent - back, 0.0)
            assert ahead < DEFAULT_CATCH_UP + 3 * 0.01


def test_after_a_thousand_resets_it_is_as_on_the_first_day(start, peer):
    simulator = start("simulator")
    peer.listen("state")
    for _ in range(RESETS // 10):
        assert peer.call(Trigger, "simulator/reset").success
    before = memory(simulator.process)
    for _ in range(RESETS - RESETS // 10):
        assert peer.call(Trigger, "simulator/reset").success
    assert memory(simulator.process) - before < GROWTH_OF_RESETS
    peer.call(SetBool, "simulator/pause", SetBool.Request(data=True))
    asked = time.time_ns()  # what was sent before it may be heard after it
    peer.call(Trigger, "simulator/reset")
    peer.wait(lambda: peer.received["state"][-1][0] > asked, "the state of a paused reset")
    first = next(message for sent, message in peer.received["state"] if sent > asked)
    fresh = Simulation(preset())
    assert list(first.data) == [0.0, *fresh.model_state]
    peer.call(Trigger, "simulator/step")
    peer.wait(lambda: peer.received["state"][-1][1].data[0] > 0.0, "the step")
    fresh.step(Command(), 0.01)
    assert list(peer.received["state"][-1][1].data) == [fresh.time, *fresh.model_state]
