"""Two simulators on the same topics: a manoeuvre detects the second one at any time."""

import pytest
from std_msgs.msg import Float64MultiArray, MultiArrayDimension

from vehicle_roll_sim.messages.run_messages import NEEDED
from vehicle_roll_sim.ros.clients.collector import Collector

pytestmark = pytest.mark.unmeasured


@pytest.fixture
def refused():
    """Message of a manoeuvre that finds two simulators: one line, no summary, status 1.

    On a busy machine it may take a while to find whether both live: a line says so.
    """

    def check(manoeuvre, *names: str) -> None:
        status, out, err = manoeuvre.finish()
        assert (status, out) == (1, ""), err
        *waiting, line = err.splitlines()
        assert all("in case one of them was killed" in each for each in waiting), err
        assert line.startswith(f"manoeuvre: error: 2 nodes publish /state: {', '.join(names)};")
        assert "allowed: one simulator per namespace" in line

    return check


def test_two_simulators_of_one_name_are_found_every_time(start, refused):
    start("simulator")
    start("simulator")
    for _ in range(2):
        refused(start("manoeuvre", "step_steer"), "/simulator", "/simulator")


def test_a_second_simulator_that_comes_later_is_found_during_the_run(start, peer, refused):
    start("simulator")
    manoeuvre = start("manoeuvre", "step_steer", "--duration", "600")
    peer.listen("applied_command")
    peer.wait(lambda: peer.newest("applied_command").data[1] != 0.0, "the manoeuvre to steer")
    start("simulator", "--ros-args", "-r", "__node:=another")
    refused(manoeuvre, "/another", "/simulator")


def test_a_simulator_that_was_killed_and_started_anew_is_no_second_one(start, peer):
    first = start("simulator")
    peer.listen("state")
    peer.newest("state")
    first.process.kill()
    start("simulator")
    status, out, err = start("manoeuvre", "step_steer", "--duration", "0.5").finish()
    assert (status, err) == (0, "")
    assert "complete" in out


def test_messages_of_two_publishers_are_told_apart_however_they_mix(peer, make_peer):
    """Even if both count from 1, and if the one that started later is received last."""
    seen = []
    collector = Collector(peer.node, seen.append)
    first, second = (
        each.node.create_publisher(Float64MultiArray, "state", 10)
        for each in (make_peer(), make_peer())
    )
    for each in (first, second):
        peer.wait(each.get_subscription_count, "a match")
    state = Float64MultiArray(data=[0.0] * (1 + len(NEEDED)))
    labels = ("time", *sorted(NEEDED))
    state.layout.dim = [MultiArrayDimension(label=label) for label in labels]

    def hears(publisher) -> bool:
        count = len(seen)
        publisher.publish(state)
        peer.wait(lambda: len(seen) > count, "the state")
        return collector.is_mixed

    assert [hears(first), hears(first), hears(second)] == [False, False, True]
    collector.forget()
    assert [hears(first), hears(first)] == [False, False]
    assert collector.simulators() == 0  # the other topics have no publisher
