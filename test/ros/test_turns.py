"""Whoever waits for messages lets every subscription have its turn, however much comes."""

import time
from collections import Counter
from unittest.mock import Mock

import pytest
from std_msgs.msg import Float64

from vehicle_roll_sim.ros import ending, recorder
from vehicle_roll_sim.ros.lockstep import Lockstep, UnansweredError
from vehicle_roll_sim.ros.simulator_client import SimulatorClient

TOPICS = ("first", "second", "last")
WAITING = 200
"""Messages on each."""
A_WHILE = 0.6
"""s, in which not all of them can be taken."""


@pytest.fixture
def taken(peer):
    """How many messages of each topic a node has taken, for which many wait."""
    counts = Counter()

    def take(topic):
        counts[topic] += 1
        time.sleep(A_WHILE / WAITING)

    for topic in TOPICS:
        peer.node.create_subscription(Float64, topic, lambda _, t=topic: take(t), WAITING)
    publishers = [peer.node.create_publisher(Float64, topic, WAITING) for topic in TOPICS]
    peer.wait(lambda: all(p.get_subscription_count() for p in publishers), "a match")
    for publisher in publishers:
        for _ in range(WAITING):
            publisher.publish(Float64())
    assert all(publisher.wait_for_all_acked() for publisher in publishers)
    return counts


def record_for_a_while(peer):
    recorder._listen(peer.executor, Mock(), A_WHILE)


def linger_for_a_while(peer):
    SimulatorClient(peer.node, peer.executor, "simulator").linger(A_WHILE)


def wait_for_an_answer(peer):
    simulator = Mock()
    simulator.session.paused, simulator.session.inbox.unanswered.return_value = False, ["last"]
    with pytest.raises(UnansweredError):
        Lockstep(["last"], [], A_WHILE, "stop")._await_answers(simulator, peer.executor)


@pytest.mark.parametrize("wait", [record_for_a_while, linger_for_a_while, wait_for_an_answer])
def test_no_subscription_starves(peer, taken, monkeypatch, wait):
    monkeypatch.setattr(ending, "shutting_down", lambda end: None)
    wait(peer)
    assert min(taken[topic] for topic in TOPICS) > 10
    assert max(taken.values()) - min(taken.values()) <= 2
    assert max(taken.values()) < WAITING
