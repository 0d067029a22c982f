"""Tests and benchmarks run in separate ROS domains."""

import socket

import pytest
from peers import Peer

from vehicle_roll_sim.ros.orchestration import domains
from vehicle_roll_sim.ros.orchestration.domains import DOMAINS, own_domain

USED_BY_PEOPLE = range(102)
SYSTEMS = range(32768, 61000)
"""Ports that Linux hands out unless told otherwise."""


@pytest.fixture
def first(monkeypatch) -> int:
    """The domain that is looked at first, and then again."""
    with own_domain() as number:
        pass
    begin = DOMAINS.index(number)
    monkeypatch.setattr(domains, "_numbers", iter([begin, begin, begin]))
    return number


def test_they_are_not_those_of_people_nor_have_they_ports_of_others():
    assert not set(DOMAINS) & set(USED_BY_PEOPLE)
    ports = {7400 + 250 * number + offset for number in DOMAINS for offset in (0, 10, 248)}
    assert not ports & set(SYSTEMS)
    assert max(ports) < 2**16


def test_two_takers_get_two_domains_and_both_are_given_back(first):
    with own_domain() as one, own_domain() as other:
        assert one == first
        assert other != one
    with own_domain() as again:
        assert again == first


@pytest.mark.parametrize("offset", [0, 10, 14])
def test_one_in_which_somebody_is_met_is_passed_over(first, offset):
    """By the ports that anybody binds in a domain: the common one, a participant's own."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as theirs:
        theirs.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        theirs.bind(("", 7400 + 250 * first + offset))
        with own_domain() as number:
            assert number != first


def test_one_with_a_node_in_it_is_passed_over(first):
    peer = Peer(first)
    try:
        with own_domain() as number:
            assert number != first
    finally:
        peer.close()


def test_it_is_said_where_all_are_in_use(monkeypatch):
    monkeypatch.setattr(domains, "_take", lambda number: None)
    monkeypatch.setattr(domains, "PATIENCE", 0.0)
    with pytest.raises(TimeoutError, match="all ROS domains from 215 to 231"), own_domain():
        pass
