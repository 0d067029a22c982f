"""Diagnostics name the cause: two nodes with one command, a second clock, a silent one."""

from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from vehicle_roll_sim.messages.command_topics import COMMANDS
from vehicle_roll_sim.messages.topics import CLOCK, STATE_SET
from vehicle_roll_sim.ros.compatibility import other_publishers

CONTROLLER = Path(__file__).parents[1] / "steady_controller.py"
STEERING = next(topic for topic in COMMANDS if topic.name == "steering_cmd")


def status_of(peer) -> DiagnosticStatus:
    return peer.newest("/diagnostics").status[0]


def wait_for_status(peer, done, what: str) -> DiagnosticStatus:
    def found():
        status = status_of(peer)
        return done(status) and status

    return peer.wait(found, what)


def test_two_publishers_of_one_command_are_a_warning_with_their_names(start, make_peer):
    peer, other = make_peer(), make_peer("/car")
    simulator = start("simulator")
    peer.listen("/diagnostics", "applied_command")
    peer.publisher("steering_cmd")
    elsewhere = other.node.create_publisher(Float64, "/steering_cmd", 1)
    status = wait_for_status(peer, lambda s: "2 publishers" in s.message, "both to be seen")
    assert status.level == DiagnosticStatus.WARN
    told = {item.key: item.value for item in status.values}
    assert told["steering_cmd publishers"] == "2"
    assert told["steering_cmd publisher names"] == "/car/peer, /peer"
    peer.command(
        {"steering_cmd": 0.01},
        lambda: peer.newest("applied_command").data[1] == 0.01,
        "the first one's command",
    )
    elsewhere.publish(Float64(data=0.02))  # the last one wins, whoever it is of
    peer.wait(lambda: peer.newest("applied_command").data[1] == 0.02, "the other one's command")
    other.node.destroy_publisher(elsewhere)
    wait_for_status(peer, lambda s: "2 publishers" not in s.message, "the end of it")
    _, _, err = simulator.finish(2)
    assert err.count("steering_cmd: 2 publishers") == 1


def test_a_second_clock_is_warned_of_loudly_and_once(start, peer):
    simulator = start("simulator", "--ros-args", "-p", "publish_clock:=true")
    peer.listen("/diagnostics")
    wait_for_status(peer, lambda s: s.level == DiagnosticStatus.OK, "a start without trouble")
    second = peer.node.create_publisher(Clock, "/clock", 1)
    status = wait_for_status(peer, lambda s: "TWO CLOCKS" in s.message, "the second clock")
    assert status.level == DiagnosticStatus.WARN
    assert "/peer" in status.message
    peer.node.destroy_publisher(second)
    wait_for_status(peer, lambda s: s.level == DiagnosticStatus.OK, "the end of it")
    _, _, err = simulator.finish(2)
    assert err.count("TWO CLOCKS") == 1


def test_somebody_elses_clock_is_no_trouble_where_none_is_published(start, peer):
    start("simulator")
    peer.node.create_publisher(Clock, "/clock", 1)
    peer.listen("/diagnostics")
    assert not any("CLOCK" in status_of(peer).message for _ in range(3))


@pytest.mark.parametrize("second", ["simulator", "other"])
def test_two_simulators_of_the_same_topics_are_warned_of_by_both(start, peer, second):
    nodes = [start("simulator"), start("simulator", "--ros-args", "-r", f"__node:={second}")]
    peer.listen("/diagnostics")
    more = len(STATE_SET) - 3
    warnings = [
        f"TWO SIMULATORS: /{name} also publishes state, applied_command, odom and {more} more"
        for name in ("simulator", second)
    ]

    def told() -> list[str]:
        """Messages of the last two statuses of each node, which has one a second."""
        recent = [message.status[0] for _, message in peer.received["/diagnostics"]][-4:]
        return [status.message for status in recent if status.level == DiagnosticStatus.WARN]

    def are_told() -> bool:
        return len(told()) == 4 and all(any(w in text for text in told()) for w in warnings)

    peer.wait(are_told, "both to be told")
    logs = [node.finish(2)[2] for node in nodes]
    assert [log.count("TWO SIMULATORS") for log in logs] == [1, 1]


def test_a_node_that_publishes_one_topic_of_the_set_is_named_with_it(start, peer):
    start("simulator", "--ros-args", "-r", "__ns:=/car")
    peer.listen("/diagnostics")
    peer.node.create_publisher(JointState, "/car/joint_states", 1)
    status = wait_for_status(peer, lambda s: "/peer also publishes" in s.message, "it to be seen")
    assert status.level == DiagnosticStatus.WARN
    assert "/peer also publishes joint_states" in status.message
    assert "SIMULATORS" not in status.message


def test_of_two_nodes_with_one_name_the_other_is_seen(make_peer):
    peer, twin = make_peer(), make_peer()
    assert other_publishers(peer.node, CLOCK) == []
    own = peer.node.create_publisher(Clock, "/clock", 1)
    assert other_publishers(peer.node, CLOCK) == []
    theirs = twin.node.create_publisher(Clock, "/clock", 1)
    peer.wait(lambda: other_publishers(peer.node, CLOCK) == ["/peer"], "the twin")
    peer.node.destroy_publisher(own)
    twin.node.destroy_publisher(theirs)


def test_those_of_another_type_or_topic_do_not_count_as_publishers(peer):
    peer.node.create_publisher(Clock, "/steering_cmd", 1)
    other = Node("other", context=peer.context, namespace="/car")
    other.create_publisher(Float64, "steering_cmd", 1)
    peer.wait(lambda: other_publishers(other, STEERING) == [], "its own to be left out")
    assert other_publishers(peer.node, STEERING) == []
    other.destroy_node()


def test_a_controller_that_falls_silent_is_a_warning_until_it_speaks_again(start, peer):
    simulator = start("simulator")
    peer.listen("/diagnostics", "applied_command")

    def torque():
        return peer.newest("applied_command").data[3]

    command = {"wheel_torque_cmd": [5.0, 0.0, 0.0, 0.0]}
    peer.command(command, lambda: torque() == 5.0, "the torque")
    peer.wait(lambda: torque() == 0.0, "its end")
    silent = "wheel_torque_cmd: no message within 0.5 s"
    status = wait_for_status(peer, lambda s: silent in s.message, "the warning")
    assert status.level == DiagnosticStatus.WARN

    def is_well():
        diagnostics = peer.received["/diagnostics"][-1][1]
        return torque() == 5.0 and diagnostics.status[0].level == DiagnosticStatus.OK

    peer.command(command, is_well, "the end of the trouble")
    _, _, err = simulator.finish(2)
    assert silent in err


def test_of_a_controller_that_is_killed_the_torque_ends_and_the_steering_is_held(start, peer):
    simulator = start("simulator")
    controller = start("", program=str(CONTROLLER))
    peer.listen("/diagnostics", "applied_command")

    def applied():
        data = peer.newest("applied_command").data
        return data[1], data[3]

    peer.wait(lambda: applied() == (0.02, 5.0), "its commands")
    controller.process.kill()
    peer.wait(lambda: applied() == (0.02, 0.0), "the end of the torque")
    told = [f"{name}: no message within 0.5 s" for name in ("steering_cmd", "wheel_torque_cmd")]
    status = wait_for_status(peer, lambda s: all(one in s.message for one in told), "warnings")
    assert status.level == DiagnosticStatus.WARN
    assert applied() == (0.02, 0.0)
    _, _, err = simulator.finish(2)
    assert all(one in err for one in told)
