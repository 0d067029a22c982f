"""Publications, status and replay after the model has stopped, been paused or been reset."""

import math

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim.messages.topics import STATE_SET

pytestmark = pytest.mark.unmeasured

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


def test_a_model_that_has_stopped_takes_no_single_step(start, peer):
    start("simulator")
    peer.listen("rollover")
    peer.command(
        {"steering_cmd": 0.2}, lambda: any(m.data for _, m in peer.received["rollover"]), "it"
    )
    assert peer.call(SetBool, "simulator/pause", SetBool.Request(data=True)).success
    answer = peer.call(Trigger, "simulator/step")
    assert not answer.success
    assert answer.message == "the model has stopped: reset first"
    assert peer.call(Trigger, "simulator/reset").success
    assert peer.call(Trigger, "simulator/step").success


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


def test_a_reset_to_a_speed_at_which_the_step_is_too_large_is_refused_and_the_run_goes_on(
    start, peer
):
    """10 ms: up to 31 ms at 50 km/h, 6 ms at rest, where the tires are stiff springs."""
    start("simulator", "--ros-args", "-p", "step:=0.01")
    peer.listen("state")
    request = SetParameters.Request(
        parameters=[Parameter("initial_speed", value=0.0).to_parameter_msg()]
    )
    assert peer.call(SetParameters, "simulator/set_parameters", request).results[0].successful
    answer = peer.call(Trigger, "simulator/reset")
    assert not answer.success
    assert "at most 0.006 s at 0 m/s" in answer.message
    before = peer.current("state").data[0]
    peer.wait(lambda: peer.newest("state").data[0] > before, "the run to go on")


def test_a_manoeuvre_says_why_its_reset_was_refused(start):
    start("simulator", "--ros-args", "-p", "step:=0.01")
    status, out, err = start("manoeuvre", "step_steer", "--speed", "0").finish()
    assert (status, out) == (1, "")
    assert "at most 0.006 s at 0 m/s" in err


def test_a_step_that_has_become_too_large_is_warned_of(start, peer):
    """4 ms is 4.3 ms at most at 40 km/h, with steady-state slip, and less when it has slowed."""
    words = ("step:=0.004", "publish_rate:=50.0", "initial_speed:=11.1", "steady_state_slip:=true")
    words = (*words, "command_timeout:=0.0")
    start("simulator", "--ros-args", *(word for each in words for word in ("-p", each)))
    peer.listen("/diagnostics")
    brakes = {"brake_torque_cmd": [150.0] * 4}
    peer.command(brakes, lambda: "the step" in status_of(peer).message, "a warning")
    assert status_of(peer).level == DiagnosticStatus.WARN
