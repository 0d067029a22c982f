"""Wrong command messages are dropped whole, counted and warned about."""

import math

import pytest

FIRST_TORQUE = 3


@pytest.mark.parametrize(
    ("topic", "good", "bad", "reason"),
    [
        ("steering_cmd", 0.02, math.nan, "finite"),
        ("wheel_torque_cmd", [5.0, 0.0, 0.0, 0.0], [1.0, math.inf, 0.0, 0.0], "finite"),
        ("brake_torque_cmd", [5.0, 0.0, 0.0, 0.0], [6.0, 0.0, 0.0, -1.0], "below 0"),
        ("normal_force_cmd", [5.0, 0.0, 0.0, 0.0], [1.0, 2.0, 3.0], "3 values, 4 are expected"),
    ],
)
def test_a_bad_message_leaves_the_last_good_one(start, peer, topic, good, bad, reason):
    simulator = start("simulator", "--ros-args", "-p", "command_timeout:=0.0")
    peer.listen("applied_command", "/diagnostics")

    def applied():
        return [value for value in peer.newest("applied_command").data[1:] if value]

    wanted = [good] if isinstance(good, float) else good[:1]
    peer.command({topic: good}, lambda: applied() == wanted, "the good command")

    def dropped():
        values = peer.newest("/diagnostics").status[0].values
        counts = {value.key: value.value for value in values}
        return int(counts[f"{topic} dropped"]) and counts

    counts = peer.command({topic: bad}, dropped, "the bad one to be counted")
    assert reason in counts[f"{topic} last problem"]
    assert applied() == wanted
    _, _, err = simulator.finish(2)
    assert f"{topic}: message dropped" in err
