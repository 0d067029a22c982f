"""Wrong command messages are dropped whole, counted and warned about."""

import math
import re
import time

import pytest

WARNED_FOR = 3.0
"""s: several times what two warnings of one kind are apart."""
LENGTHS = (0, 1, 3, 5, 1_000_000)
"""All wrong."""


def told_by(peer) -> dict[str, str]:
    return {value.key: value.value for value in peer.newest("/diagnostics").status[0].values}


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
        counts = told_by(peer)
        return int(counts[f"{topic} dropped"]) and counts

    counts = peer.command({topic: bad}, dropped, "the bad one to be counted")
    assert reason in counts[f"{topic} last problem"]
    assert applied() == wanted
    _, _, err = simulator.finish(2)
    assert f"{topic}: message dropped" in err


def test_messages_of_any_wrong_length_are_dropped_and_say_so(start, peer):
    start("simulator", "--ros-args", "-p", "command_timeout:=0.0")
    peer.listen("applied_command", "/diagnostics")

    def torque():
        return peer.newest("applied_command").data[3]

    peer.command({"wheel_torque_cmd": [5.0, 0.0, 0.0, 0.0]}, lambda: torque() == 5.0, "a good one")
    for length in LENGTHS:
        reason = f"message dropped: {length} values, 4 are expected"

        def is_told(reason=reason):
            return told_by(peer)["wheel_torque_cmd last problem"] == reason

        peer.command({"wheel_torque_cmd": [6.0] * length}, is_told, reason)
        assert torque() == 5.0


def test_bad_messages_are_told_in_the_log_once_a_second(start, peer):
    simulator = start("simulator")
    peer.listen("/diagnostics")
    bad = {"steering_cmd": math.nan}
    peer.command(bad, lambda: int(told_by(peer)["steering_cmd dropped"]), "the first one")
    until = time.monotonic() + WARNED_FOR
    peer.command(bad, lambda: time.monotonic() > until and peer.newest("/diagnostics"), "the rest")
    _, _, err = simulator.finish(2)
    lines = [line for line in err.splitlines() if "steering_cmd: message dropped" in line]
    assert all("every value must be finite" in line for line in lines)
    told = [float(re.search(r"\[(\d+\.\d+)\]", line).group(1)) for line in lines]
    assert len(told) > WARNED_FOR - 1.0
    assert len(told) - 2 < told[-1] - told[0]  # s: one apart, but for what a busy machine delays
