"""What is published, reported and played when the model has stopped, is paused or is reset."""

import math

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim.messages.topics import STATE_SET

HUGE = 1e308
"""Finite, but its multiples are not."""
HARDLY_LIMITED = ("-p", "wheel_torque_limit:=1e6", "-p", "normal_force_limit:=1e6")


def numbers_in(message) -> list[float]:
    """Every float of a message, however deep."""
    if isinstance(message, float):
        return [message]
    if hasattr(message, "get_fields_and_field_types"):
        fields = message.get_fields_and_field_types()
        return [n for name in fields for n in numbers_in(getattr(message, name))]
    if isinstance(message, (list, tuple, np.ndarray)) or hasattr(message, "typecode"):
        return [n for element in message for n in numbers_in(element)]
    return []


def status_of(peer) -> DiagnosticStatus:
    return peer.newest("/diagnostics").status[0]


def test_after_a_divergence_everything_published_is_finite_and_a_reset_recovers(start, peer):
    start("simulator", "--ros-args", *HARDLY_LIMITED)
    names = [topic.name for topic in STATE_SET]
    peer.listen(*names, "/diagnostics")
    commands = {"normal_force_cmd": [HUGE] * 4, "wheel_torque_cmd": [HUGE] * 4}
    peer.command(commands, lambda: "diverged" in status_of(peer).message, "a divergence")
    assert status_of(peer).level == DiagnosticStatus.ERROR
    for name in names:
        numbers = numbers_in(peer.newest(name))
        assert all(map(math.isfinite, numbers)), name
    assert peer.call(Trigger, "simulator/reset").success
    peer.wait(lambda: status_of(peer).message == "running", "a new start")


def test_a_rollover_is_an_error_in_diagnostics(start, peer):
    start("simulator")
    peer.listen("/diagnostics")
    peer.command({"steering_cmd": 0.2}, lambda: "rolled over" in status_of(peer).message, "it")
    assert status_of(peer).level == DiagnosticStatus.ERROR


def test_stamps_keep_rising_over_a_reset(start, peer):
    start("simulator")
    peer.listen("imu", "state")
    peer.wait(lambda: peer.newest("state").data[0] > 0.2, "some time")
    peer.call(Trigger, "simulator/reset")
    peer.wait(lambda: peer.newest("state").data[0] < 0.2, "the new start")
    peer.newest("imu")
    stamps = [m.header.stamp.sec * 10**9 + m.header.stamp.nanosec for _, m in peer.received["imu"]]
    assert all(np.diff(stamps) > 0)


@pytest.mark.parametrize("rollover_angle", ["1", "0.5"])
def test_a_manoeuvre_knows_the_rollover_angle_of_the_simulator(start, peer, rollover_angle):
    start("simulator", "--ros-args", "-p", f"rollover_angle:={rollover_angle}")
    status, out, _ = start("manoeuvre", "j_turn").finish()
    assert status == 0
    assert "rolled over" in out
    peak = next(line for line in out.splitlines() if line.startswith("peak roll"))
    assert float(peak.split()[3]) == pytest.approx(math.degrees(float(rollover_angle)), abs=1.5)


def test_a_manoeuvre_against_a_paused_simulator_says_so(start, peer):
    start("simulator")
    peer.call(SetBool, "simulator/pause", SetBool.Request(data=True))
    status, _, err = start("manoeuvre", "j_turn").finish()
    assert status == 1
    assert "paused" in err


def test_a_manoeuvre_that_ends_in_a_divergence_does_not_pass_for_complete(start, peer):
    start("simulator", "--ros-args", *HARDLY_LIMITED)
    peer.listen("state")
    driver = start("manoeuvre", "j_turn")
    torques = {"wheel_torque_cmd": [HUGE] * 4, "normal_force_cmd": [HUGE] * 4}
    peer.command(torques, lambda: driver.process.poll() is not None, "the end of the manoeuvre")
    status, out, _ = driver.finish()
    assert status == 1
    assert "diverged" in out
