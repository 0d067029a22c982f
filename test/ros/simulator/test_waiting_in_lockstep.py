"""In lockstep nothing starts before all are connected, and endless waits are reported."""

import os
import signal
import threading
import time
from unittest.mock import Mock

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from lockstep_partner import LOCKSTEP, answered, begin
from rclpy.executors import ExternalShutdownException
from recordings import heard_so_far
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim.ros.simulator import lockstep


def test_nothing_is_sent_before_the_partners_are_there(start, peer):
    simulator = start(*LOCKSTEP, "-p", "lockstep_wait:=[imu]")
    peer.listen("state")
    peer.publisher("steering_cmd")
    # it answers services while it waits, and a reset then must not begin the run
    assert peer.call(Trigger, "simulator/reset").success
    assert peer.received["state"] == []
    peer.listen("imu")
    assert peer.newest("state").data[0] == 0.0
    _, _, err = simulator.finish(2)
    assert "lockstep: waiting for" in err
    assert "a subscriber on imu" in err


def test_it_goes_on_when_all_have_received_the_first_set(start, peer, tmp_path):
    bag = tmp_path / "bag"
    start(*LOCKSTEP, "-p", "lockstep_wait:=[imu]")
    recorder = start("recorder", "--output", str(bag)).process
    peer.wait(lambda: "/simulation_description" in heard_so_far(bag), "the recorder to hear")
    os.kill(recorder.pid, signal.SIGSTOP)  # known to the simulator, and deaf
    peer.listen("state", "/diagnostics")
    peer.newest("/diagnostics")  # the simulator knows of both
    peer.publish("steering_cmd", 0.01)
    peer.wait(lambda: peer.received["state"], "the first set")
    peer.publish("steering_cmd", 0.01)
    assert peer.newest("/diagnostics")
    assert [state.data[0] for _, state in peer.received["state"]] == [0.0]
    os.kill(recorder.pid, signal.SIGCONT)
    peer.wait(lambda: peer.received["state"][-1][1].data[0] == 0.01, "the next set")


def test_a_listener_that_never_receives_is_not_waited_for_for_ever(monkeypatch):
    monkeypatch.setattr(lockstep, "LONGEST_RECEIPT", 0.05)
    simulator, executor = Mock(), Mock()
    simulator.unreceived.return_value = ["/imu", "/state"]
    simulator.run_period.side_effect = ExternalShutdownException
    simulator.session.paused, simulator.session.inbox.unanswered.return_value = False, []
    simulator.lock = threading.Lock()
    simulator.missing_partners.return_value = []
    driver = lockstep.Lockstep([], [], 0.0, "hold")
    with pytest.raises(ExternalShutdownException):
        driver.run(simulator, executor)
    (warning,) = simulator.get_logger().warning.call_args.args
    assert "has not received /imu, /state" in warning


def wait_for_warning(peer, *texts: str) -> None:
    def is_told():
        status = peer.newest("/diagnostics").status[0]
        is_warning = status.level == DiagnosticStatus.WARN
        return is_warning and all(text in status.message for text in texts)

    peer.wait(is_told, f"a warning: {texts}")


def test_a_long_wait_is_a_warning_that_names_what_is_waited_for_and_whose_it_is(start, peer):
    start(*LOCKSTEP, "-p", "lockstep_topics:=[steering_cmd, brake_torque_cmd]")
    peer.listen("/diagnostics", "state")
    missing = "a publisher on steering_cmd and a publisher on brake_torque_cmd"
    wait_for_warning(peer, f"lockstep: waiting for {missing} for ", " s")
    peer.publisher("steering_cmd")
    brake = peer.publisher("brake_torque_cmd")
    peer.wait(lambda: peer.received["state"], "the first set")
    peer.publish("steering_cmd", 0.01)
    wait_for_warning(peer, "lockstep: waiting for a message on brake_torque_cmd from /peer for ")
    peer.node.destroy_publisher(brake)
    wait_for_warning(peer, "a message on brake_torque_cmd, which no known node publishes, for ")


def test_an_answer_ends_the_warning_of_a_long_wait(start, peer):
    begin(start, peer)
    peer.listen("/diagnostics")
    wait_for_warning(peer, "a message on steering_cmd from /peer")

    def is_well():
        peer.publish("steering_cmd", 0.01)
        status = peer.newest("/diagnostics").status[0]
        return (status.level, status.message) == (DiagnosticStatus.OK, "running")

    peer.wait(is_well, "the end of the warning")


def test_without_an_answer_in_time_it_stops_and_names_the_topic(start, peer):
    words = ("-p", "lockstep_timeout:=0.5", "-p", "lockstep_timeout_policy:=stop")
    simulator = begin(start, peer, *words)
    status, _, err = simulator.finish()
    assert status == 1
    assert err.splitlines()[-1].startswith("simulator: error: steering_cmd: no message within 0.5")


def test_an_answer_that_waits_to_be_read_is_not_late(start, peer):
    words = ("-p", "lockstep_timeout:=0.5", "-p", "lockstep_timeout_policy:=stop")
    simulator = begin(start, peer, *words)
    os.kill(simulator.process.pid, signal.SIGSTOP)  # a simulator that does not get its turn
    peer.publish("steering_cmd", 0.01)
    time.sleep(1.0)  # the wait itself is what is tried: longer than the timeout
    os.kill(simulator.process.pid, signal.SIGCONT)
    peer.wait(lambda: peer.received["state"][-1][1].data[0] == 0.01, "the next state")


def test_a_command_from_before_the_first_set_is_no_answer_to_it(start, peer):
    start(*LOCKSTEP, "-p", "lockstep_wait:=[imu]")
    peer.listen("state")
    peer.publish("steering_cmd", 0.07)
    assert peer.call(Trigger, "simulator/reset").success  # what was sent before has been read
    peer.publish("steering_cmd", 0.07)
    peer.call(SetBool, "simulator/pause", SetBool.Request(data=False))
    peer.listen("imu")
    peer.wait(lambda: peer.received["state"], "the first set")
    assert answered(peer, 0.01).data[0] == 0.01


def test_the_first_set_is_of_time_0_whatever_is_asked_before(start, peer):
    start(*LOCKSTEP, "-p", "lockstep_wait:=[imu]")
    peer.listen("state")
    peer.publisher("steering_cmd")
    assert peer.call(SetBool, "simulator/pause", SetBool.Request(data=True)).success
    answer = peer.call(Trigger, "simulator/step")
    assert not answer.success
    assert "not started" in answer.message
    peer.listen("imu")
    assert peer.call(SetBool, "simulator/pause", SetBool.Request(data=False)).success
    assert peer.newest("state").data[0] == 0.0


def test_without_an_answer_in_time_it_goes_on_with_the_last_command(start, peer):
    begin(start, peer, "-p", "lockstep_timeout:=0.1")
    peer.listen("applied_command", "/diagnostics")
    answered(peer, 0.03)
    peer.wait(lambda: peer.newest("state").data[0] > 0.03, "periods without answers")
    assert peer.newest("applied_command").data[1] == 0.03

    def complains():
        return "no answer in time" in peer.newest("/diagnostics").status[0].message

    peer.wait(complains, "a warning")
