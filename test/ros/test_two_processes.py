"""A simulator in one process, this test in another: commands, sets, reset, services."""

import signal

import pytest
from peers import sets_of
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim import LF, Simulation, preset

pytestmark = pytest.mark.unmeasured

ROLL, U = 4, 7
"""Places in `state`, whose first element is the time."""


@pytest.fixture
def simulator(start):
    return start("simulator")


def reset(peer):
    return peer.call(Trigger, "simulator/reset")


def roll_over(peer):
    """Steer hard until the vehicle has rolled over."""

    def rolled_over():
        return peer.received["rollover"] and peer.received["rollover"][-1][1].data

    peer.command({"steering_cmd": 0.2}, rolled_over, "a rollover")


def test_commands_of_one_process_change_the_state_of_the_other(simulator, peer):
    peer.listen("state", "applied_command")
    assert peer.newest("state").data[ROLL] == pytest.approx(0.0, abs=1e-9)  # equilibrium

    def leans():
        return peer.newest("state").data[ROLL] > 0.01

    peer.command({"steering_cmd": 0.035}, leans, "roll to the outside of a left turn")
    assert peer.newest("applied_command").data[1] == 0.035


def test_lift_off_flags_equal_zero_load_in_every_set(simulator, peer):
    names = ("tire_normal_forces", "lift_off", "load_transfer_ratio")
    peer.listen("state", *names, "rollover")
    peer.wait(lambda: sets_of(peer.received, *names), "a whole set")
    roll_over(peer)
    sets = sets_of(peer.received, *names)
    flags = [list(found["lift_off"].data) for found in sets]
    assert flags == [[int(fz == 0.0) for fz in s["tire_normal_forces"].data] for s in sets]
    assert [0, 0, 0, 0] in flags
    assert [1, 0, 1, 0] in flags
    for found in sets:
        lf, rf, lr, rr = found["tire_normal_forces"].data
        total = lf + rf + lr + rr
        ratio = (rf + rr - lf - lr) / total if total else 0.0
        assert found["load_transfer_ratio"].data == pytest.approx(ratio, abs=1e-12)  # rounding


def test_a_rollover_stops_time_latches_and_a_reset_recovers(simulator, peer):
    peer.listen("state", "rollover")
    roll_over(peer)
    stopped_at = peer.current("state").data
    assert list(peer.newest("state").data) == list(stopped_at)  # goes on being published

    assert reset(peer).success
    peer.wait(lambda: peer.received["rollover"][-1][1].data is False, "rollover taken back")
    peer.wait(lambda: peer.current("state").data[0] > 0.0, "time to go on")


def test_a_reset_returns_the_initial_state_to_the_bit(simulator, peer):
    peer.listen("state")
    peer.command({"steering_cmd": 0.05}, lambda: peer.newest("state").data[ROLL] > 0.01, "roll")
    assert peer.newest("state").data[0] > 0.0
    before = len(peer.received["state"])
    reset(peer)

    def first_after_reset():
        states = [message for _, message in peer.received["state"][before:]]
        return next((state for state in states if state.data[0] == 0.0), None)

    first = peer.wait(first_after_reset, "time 0")
    fresh = Simulation(preset())
    assert list(first.data) == [0.0, *fresh.model_state]
    assert len(first.data) == 1 + 28 + 8
    names = [dimension.label for dimension in first.layout.dim]
    assert (names[0], names[ROLL], names[U]) == ("time", "roll", "u")
    assert (names[28], names[-1]) == ("wheel_speed_rr", "lateral_slip_rr")


def test_initial_speed_is_applied_by_a_reset(simulator, peer):
    peer.listen("state")
    speed = Parameter("initial_speed", value=20).to_parameter_msg()  # an integer serves
    answer = peer.call(
        SetParameters, "simulator/set_parameters", SetParameters.Request(parameters=[speed])
    )
    assert answer.results[0].successful
    reset(peer)
    peer.wait(lambda: peer.newest("state").data[U] == pytest.approx(20.0), "20 m/s")


def test_stepping_needs_a_pause_and_goes_one_period(simulator, peer):
    peer.listen("state")
    refused = peer.call(Trigger, "simulator/step")
    assert not refused.success
    assert "pause" in refused.message

    peer.call(SetBool, "simulator/pause", SetBool.Request(data=True))
    reset(peer)
    for _ in range(3):
        assert peer.call(Trigger, "simulator/step").success
    peer.wait(lambda: peer.received["state"][-1][1].data[0] == pytest.approx(0.03), "3 steps")
    peer.call(SetBool, "simulator/pause", SetBool.Request(data=False))
    peer.wait(lambda: peer.newest("state").data[0] > 0.05, "time to go on")


def test_a_dead_controller_is_noticed(simulator, peer):
    peer.listen("applied_command", "/diagnostics")
    first_torque = 3 + LF

    def drives(torque):
        return lambda: peer.newest("applied_command").data[first_torque] == torque

    commands = {"wheel_torque_cmd": [10.0, 0.0, 0.0, 0.0], "steering_cmd": 0.01}
    steered = lambda: peer.newest("applied_command").data[1] == 0.01  # noqa: E731
    peer.command(commands, lambda: drives(10.0)() and steered(), "both to be applied")
    peer.wait(drives(0.0), "the torque to be given up after command_timeout")
    assert peer.newest("applied_command").data[1] == 0.01  # steering holds by default
    newest = lambda: peer.newest("/diagnostics").status[0].message  # noqa: E731
    peer.wait(lambda: "wheel_torque_cmd: no message within 0.5 s" in newest(), "a warning")


@pytest.mark.parametrize("signum", [signal.SIGINT, signal.SIGTERM])
def test_signals_end_it_with_status_0_and_no_traceback(simulator, peer, signum):
    peer.listen("state")
    status, out, err = simulator.finish(signum)
    assert status == 0
    assert "Traceback" not in out + err


def test_two_vehicles_in_two_namespaces_are_independent(start, make_peer):
    start("simulator", "--ros-args", "-r", "__ns:=/a")
    start("simulator", "--ros-args", "-r", "__ns:=/b")
    a, b = make_peer("/a"), make_peer("/b")
    a.listen("state")
    b.listen("state")

    def a_leans():
        return a.newest("state").data[ROLL] > 0.02

    a.command({"steering_cmd": 0.05}, a_leans, "a to lean")
    assert b.current("state").data[ROLL] == pytest.approx(0.0, abs=1e-9)  # still in equilibrium
