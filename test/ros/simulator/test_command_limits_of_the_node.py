"""The node clamps commands beyond its limits, in real time and lockstep, and reports it."""

import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter

STEERING = 1
"""Place in applied_command."""
FIRST_OF = {"wheel_torque_cmd": 3, "brake_torque_cmd": 7, "normal_force_cmd": 11}
LIMITS = {"wheel_torque_cmd": 5000.0, "brake_torque_cmd": 10_000.0, "normal_force_cmd": 5000.0}
LOCKSTEP = ("--ros-args", "-p", "mode:=lockstep")


def told_by(peer) -> dict[str, str]:
    return {item.key: item.value for item in peer.newest("/diagnostics").status[0].values}


def set_parameter(peer, name, value):
    request = SetParameters.Request(parameters=[Parameter(name, value=value).to_parameter_msg()])
    return peer.call(SetParameters, "simulator/set_parameters", request).results[0]


def answered(peer, value: float) -> float:
    """The steering that is applied after an answer in lockstep."""
    before = len(peer.received["applied_command"])
    peer.publish("steering_cmd", value)
    peer.wait(lambda: len(peer.received["applied_command"]) > before, "what was applied")
    return peer.received["applied_command"][-1][1].data[STEERING]


def begin_lockstep(start, peer, *words):
    simulator = start("simulator", *LOCKSTEP, "-p", "lockstep_wait:=[applied_command]", *words)
    peer.listen("applied_command")
    peer.publisher("steering_cmd")
    peer.wait(lambda: peer.received["applied_command"], "the first set")
    return simulator


@pytest.mark.parametrize("huge", [1e10, 1e308])
def test_what_is_applied_in_real_time_is_the_limit(start, peer, huge):
    simulator = start("simulator", "--ros-args", "-p", "steering_limit:=0.02")
    peer.listen("applied_command", "/diagnostics")
    commands = {"steering_cmd": -huge, **{topic: [huge, 0.0, 1.0, 0.0] for topic in FIRST_OF}}
    commands["speed_cmd"] = huge

    def is_clamped():
        data = peer.newest("applied_command").data
        forces = [list(data[at : at + 4]) for at in FIRST_OF.values()]
        wanted = [[limit, 0.0, 1.0, 0.0] for limit in LIMITS.values()]
        return data[STEERING] == -0.02 and forces == wanted

    peer.command(commands, is_clamped, "the limits to be applied")

    def counted():
        told = told_by(peer)
        return all(int(told[f"{topic} clamped"]) for topic in commands) and told

    told = peer.command(commands, counted, "the clamped ones to be counted")
    for topic in commands:
        assert told[f"{topic} dropped"] == "0"
        assert told[f"{topic} last problem"].startswith("clamped: ")
    _, _, err = simulator.finish(2)
    for topic in commands:  # none hides the warning of another
        assert f"{topic}: clamped: " in err


def test_a_flood_of_one_kind_hides_no_other_warning(start, peer):
    simulator = start("simulator")
    peer.listen("/diagnostics")

    def dropped():
        told = told_by(peer)
        return int(told["steering_cmd dropped"]) and int(told["speed_cmd dropped"])

    wrong = {"steering_cmd": float("nan"), "speed_cmd": float("inf")}
    peer.command(wrong, dropped, "both to be dropped")
    _, _, err = simulator.finish(2)
    assert "steering_cmd: message dropped" in err
    assert "speed_cmd: message dropped" in err


def test_in_lockstep_steering_is_clamped_and_limited_in_rate_to_the_bit(start, peer):
    words = ("-p", "steering_limit:=0.02", "-p", "steering_rate_limit:=1.0")
    begin_lockstep(start, peer, *words)
    assert [answered(peer, 0.5) for _ in range(4)] == [0.01, 0.02, 0.02, 0.02]
    assert [answered(peer, 0.0) for _ in range(3)] == [0.01, 0.0, 0.0]


def test_a_limit_that_is_set_while_it_runs_counts_from_the_next_period(start, peer):
    begin_lockstep(start, peer)
    assert answered(peer, 0.05) == 0.05
    assert set_parameter(peer, "steering_limit", 0.03).successful
    assert answered(peer, 0.05) == 0.03
    refused = set_parameter(peer, "steering_limit", 3.0)
    assert not refused.successful
    assert "steering_limit" in refused.reason
    assert "1.57" in refused.reason
    assert set_parameter(peer, "steering_limit", 1).successful  # an integer serves
    assert answered(peer, 0.05) == 0.05
    assert "read-only" in set_parameter(peer, "catch_up_limit", 0.2).reason
