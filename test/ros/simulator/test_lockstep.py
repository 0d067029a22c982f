"""In lockstep results depend only on the commands, across pauses, resets and bad answers."""

import json
import sys
from pathlib import Path

import pytest
from lockstep_controller import answers
from lockstep_partner import LOCKSTEP, answered, begin
from rcl_interfaces.srv import GetParameters
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim import Command, Simulation, preset

pytestmark = pytest.mark.unmeasured

CONTROLLER = str(Path(__file__).with_name("lockstep_controller.py"))
PERIODS, PERIOD = 300, 0.01
"""And s: the vehicle rolls over on the way."""
BESIDE = 100
"""Periods of a run beside CPU hogs: each meets them."""
OF_VEHICLE = {
    "side_force_area": 4.0,
    "steering_actuator_frequency": 6.0,
    "steering_actuator_dead_time": 0.015,
    "normal_force_actuator_time_constant": 0.02,
}
"""What the reference vehicle does not have."""
GIVEN = (
    "lockstep_topics:=[steering_cmd, normal_force_cmd, wind_cmd]",
    *("-p", "normal_force_limit:=1e6"),
    *(word for name, value in OF_VEHICLE.items() for word in ("-p", f"vehicle.{name}:={value}")),
)


@pytest.fixture
def hog(started):
    """Two processes that want a core each."""
    return [started([sys.executable, "-c", "while True: pass"]) for _ in range(2)]


def heard_in_a_run(start, periods: int = PERIODS):
    """What a controller in a process of its own hears from a fresh simulator."""
    simulator = start(*LOCKSTEP, "-p", *GIVEN)
    status, out, err = start("controller", str(periods), program=CONTROLLER).finish()
    simulator.close()
    assert status == 0, err
    return json.loads(out)


_heard = []


@pytest.fixture
def heard(start):
    """That of a run on a quiet machine, which is made once."""
    if not _heard:
        _heard.append(heard_in_a_run(start))
    return _heard[0]


def test_two_runs_send_the_same_messages_one_of_them_beside_cpu_hogs(start, request):
    alone = heard_in_a_run(start, BESIDE)
    request.getfixturevalue("hog")
    assert heard_in_a_run(start, BESIDE) == alone


def test_a_set_comes_for_every_answer_and_none_besides(heard):
    counts = {name: count for name, count in heard["counts"].items() if name != "rollover"}
    assert set(counts.values()) == {PERIODS + 1}
    assert heard["counts"]["rollover"] == 2  # false at the start, then true


def test_the_states_are_those_of_the_simulation_without_middleware(heard):
    simulation = Simulation(preset().with_values(OF_VEHICLE))
    for _ in range(PERIODS):
        commands = answers([simulation.time, *simulation.model_state])
        command = Command(
            steering=commands["steering_cmd"],
            normal_force=commands["normal_force_cmd"],
            wind=commands["wind_cmd"],
        )
        simulation.step(command, PERIOD)
    assert simulation.condition.name == "ROLLED_OVER"
    assert heard["state"] == [simulation.time, *simulation.model_state]  # to the bit


def test_stamps_and_the_clock_are_simulated_time(start, peer):
    begin(start, peer)
    peer.listen("/clock")
    times = [answered(peer).data[0] for _ in range(3)]
    assert times == [0.01, 0.02, 0.03]
    peer.wait(lambda: len(peer.received["imu"]) > 3, "imu")
    stamp = peer.received["imu"][3][1].header.stamp
    assert (stamp.sec, stamp.nanosec) == (0, 30_000_000)

    def clocks():
        return [(m.clock.sec, m.clock.nanosec) for _, m in peer.received["/clock"]]

    peer.wait(lambda: (0, 30_000_000) in clocks(), "the clock of the last set")
    assert clocks()[-1] == (0, 30_000_000)


def test_a_wrong_answer_counts_as_one_and_leaves_the_last_command(start, peer):
    begin(start, peer)
    peer.listen("applied_command")
    answered(peer, 0.02)
    assert answered(peer, float("nan")).data[0] == 0.02
    peer.wait(lambda: len(peer.received["applied_command"]) >= 2, "what was applied")
    assert peer.received["applied_command"][-1][1].data[1] == 0.02


def test_a_command_that_pauses_longer_than_its_timeout_holds(start, peer):
    begin(start, peer, "-p", "command_timeout:=0.02", "-p", "steering_timeout_policy:=centre")
    peer.listen("applied_command")
    peer.publish("rear_steering_cmd", 0.01)  # on no topic of lockstep: it comes when it comes

    def rear_steering():
        sets = len(peer.received["state"])
        answered(peer)
        peer.wait(lambda: len(peer.received["applied_command"]) >= sets, "what was applied")
        return peer.received["applied_command"][-1][1].data[2]

    peer.wait(lambda: rear_steering() == 0.01, "the command to be applied")
    assert [rear_steering() for _ in range(10)] == [0.01] * 10


def test_a_reset_begins_again_and_the_run_is_the_same(start, peer):
    begin(start, peer)
    first = [list(answered(peer, 0.05).data) for _ in range(5)]
    before = len(peer.received["state"])
    assert peer.call(Trigger, "simulator/reset").success
    peer.wait(lambda: len(peer.received["state"]) > before, "the first set")
    assert peer.received["state"][-1][1].data[0] == 0.0
    assert [list(answered(peer, 0.05).data) for _ in range(5)] == first


def test_a_pause_holds_the_answer_back(start, peer):
    begin(start, peer)
    peer.listen("/diagnostics")
    assert peer.call(SetBool, "simulator/pause", SetBool.Request(data=True)).success
    peer.publish("steering_cmd", 0.01)

    def received():
        counts = {item.key: item.value for item in peer.newest("/diagnostics").status[0].values}
        return counts["steering_cmd received"]

    peer.wait(lambda: received() == "1", "the answer to be read")
    assert peer.received["state"][-1][1].data[0] == 0.0
    assert peer.call(Trigger, "simulator/step").success
    peer.wait(lambda: peer.received["state"][-1][1].data[0] == 0.01, "one period")
    assert peer.call(SetBool, "simulator/pause", SetBool.Request(data=False)).success
    assert answered(peer).data[0] == 0.02


def test_pauses_leave_every_state_as_it_would_have_been(start, peer):
    begin(start, peer)
    simulation = Simulation(preset())

    def newest():
        return list(peer.received["state"][-1][1].data)

    for number, value in enumerate((0.02, 0.05, 0.04, -0.03, -0.06, 0.01)):
        answers_paused = number % 2 == 1
        peer.call(SetBool, "simulator/pause", SetBool.Request(data=True))
        if answers_paused:
            peer.publish("steering_cmd", value)
        peer.call(SetBool, "simulator/pause", SetBool.Request(data=False))
        if not answers_paused:
            peer.publish("steering_cmd", value)
        simulation.step(Command(steering=value), PERIOD)
        peer.wait(lambda: newest()[0] == simulation.time, "the next set")
        assert newest() == [simulation.time, *simulation.model_state]  # to the bit


def test_it_is_real_time_unless_asked_otherwise(start, peer):
    start("simulator")
    request = GetParameters.Request(names=["mode", "real_time_factor"])
    answer = peer.call(GetParameters, "simulator/get_parameters", request)
    assert answer.values[0].string_value == "real_time"
    assert answer.values[1].double_value == 1.0
