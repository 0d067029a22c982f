"""The session that the tests of this folder drive."""

import pytest

from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session

PERIOD_NS = 10_000_000
SPEED = 20.0
"""m/s: not the default, so that a session that forgets it is found out."""


@pytest.fixture
def session(simulation) -> Session:
    """A session of 10 ms periods at 20 m/s, whose commands are given up after 0.5 s."""
    return Session(simulation, CommandInbox(), PERIOD_NS, SPEED)
