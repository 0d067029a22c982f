"""Receivers serve every subscription, however many messages arrive."""

import time
from collections import Counter
from unittest.mock import Mock

import pytest
import rclpy
from std_msgs.msg import Float64, Float64MultiArray

from vehicle_roll_sim.ros.clients.recorder import Recorder
from vehicle_roll_sim.ros.clients.simulator_client import SimulatorClient
from vehicle_roll_sim.ros.simulator.lockstep import Lockstep, UnansweredError

TOPICS = ("first", "second", "last")
WAITING = 200
"""Messages on each."""
A_WHILE = 2.0
"""Time (s), too short to receive all messages."""


@pytest.fixture
def taken(peer):
    """Number of messages that a node has received on each topic while many are queued."""
    counts = Counter()

    def take(topic):
        counts[topic] += 1
        time.sleep(A_WHILE / WAITING)

    for topic in TOPICS:
        peer.node.create_subscription(Float64, topic, lambda _, t=topic: take(t), WAITING)
    send(peer, TOPICS, Float64)
    return counts


def send(peer, topics, kind):
    """Send many messages on each topic and wait until the subscriber's queues hold them."""
    publishers = [peer.node.create_publisher(kind, topic, WAITING) for topic in topics]
    peer.wait(lambda: all(p.get_subscription_count() for p in publishers), "a match")
    for publisher in publishers:
        for _ in range(WAITING):
            publisher.publish(kind())
    assert all(publisher.wait_for_all_acked() for publisher in publishers)


def linger_for_a_while(peer):
    SimulatorClient(peer.node, peer.executor, "simulator").linger(A_WHILE)


def wait_for_an_answer(peer):
    simulator = Mock()
    simulator.session.paused, simulator.session.inbox.unanswered.return_value = False, ["last"]
    with pytest.raises(UnansweredError):
        Lockstep(["last"], [], A_WHILE, "stop")._await_answers(simulator, peer.executor)


@pytest.mark.parametrize("wait", [linger_for_a_while, wait_for_an_answer])
def test_no_subscription_starves(peer, taken, wait):
    wait(peer)
    assert min(taken[topic] for topic in TOPICS) > 10
    assert max(taken.values()) - min(taken.values()) <= 2
    assert max(taken.values()) < WAITING


@pytest.fixture
def recorder(domain):
    rclpy.init(domain_id=domain)
    node = Recorder()
    yield node
    node.destroy_node()
    rclpy.shutdown()


def test_a_recorder_writes_all_that_has_come_at_one_look(peer, recorder):
    bag, connections = Mock(), ("/state", "/applied_command", "/tire_normal_forces")
    bag.add_topic = lambda topic, name: name
    recorder.begin(bag)
    send(peer, connections, Float64MultiArray)
    recorder.take()
    written = Counter(call.args[0] for call in bag.write.call_args_list)
    assert written == dict.fromkeys(connections, WAITING)
