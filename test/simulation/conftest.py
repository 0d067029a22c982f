"""The simulation that the tests of this folder drive, and the folder that they write to."""

import os
from pathlib import Path

import pytest

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.simulation.command_inbox import CommandInbox
from vehicle_roll_sim.simulation.session import Session

PERIOD_NS = 10_000_000
SPEED = 20.0
"""m/s: not the default, so that a session that forgets it is found out."""


@pytest.fixture
def simulation() -> Simulation:
    """The reference vehicle at 50 km/h, with a step of 1 ms."""
    return Simulation(preset())


@pytest.fixture
def session(simulation) -> Session:
    """A session of 10 ms periods at 20 m/s, whose commands are given up after 0.5 s."""
    return Session(simulation, CommandInbox(), PERIOD_NS, SPEED)


@pytest.fixture
def umask():
    """Sets the umask of the process until the end of the test."""
    before = os.umask(0o022)
    yield os.umask
    os.umask(before)


@pytest.fixture
def path(tmp_path, monkeypatch):
    """A name in an empty folder; short, so that messages show it whole."""
    monkeypatch.chdir(tmp_path)
    return Path("result.csv")
