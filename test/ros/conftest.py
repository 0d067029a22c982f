"""Fixtures: a ROS domain for each test, and processes and peers that end with it."""

import os
import subprocess
import tempfile

import launch_files
import pytest
import rclpy
from forked import SERVER, open_process
from peers import Peer, Process
from rclpy.context import Context

from vehicle_roll_sim.ros.orchestration.domains import own_domain

RECORDING = ("recorder", "demo")
"""Programs that write bags."""


@pytest.fixture(autouse=True)
def local_discovery(monkeypatch, tmp_path):
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "ros_log"))


@pytest.fixture(scope="session", autouse=True)
def fork_server():
    """The program from which processes are forked ends with the tests."""
    yield
    SERVER.close()


@pytest.fixture
def domain():
    """The ROS domain of a test, which nobody else on this machine has meanwhile."""
    with own_domain() as number:
        yield number


@pytest.fixture
def context(domain):
    """A context of rclpy in the test's domain, for nodes in the test process."""
    made = Context()
    rclpy.init(context=made, domain_id=domain)
    yield made
    rclpy.shutdown(context=made)


@pytest.fixture
def opened():
    """opened(command, fresh, ...): a process of `open_process`, which ends with its test."""
    processes = []

    def open_one(command, **options):
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        processes.append(open_process(command, env=dict(os.environ), **pipes, **options))
        return processes[-1]

    yield open_one
    for process in reversed(processes):
        process.kill()
        process.communicate()


@pytest.fixture
def start(domain):
    """start(module, *words, program, fresh): a process (`Process`) in the test's domain."""
    processes = []

    def start_process(*arguments, **options):
        if arguments[0] in RECORDING:
            pytest.importorskip("rosbags", reason="the recorder needs the library rosbags")
        processes.append(Process(domain, *arguments, **options))
        return processes[-1]

    yield start_process
    for process in reversed(processes):
        process.close()


@pytest.fixture
def make_peer(domain):
    """make_peer(namespace): a node in the test's domain."""
    peers = []

    def make(namespace=""):
        peers.append(Peer(domain, namespace))
        return peers[-1]

    yield make
    for peer in peers:
        peer.close()


@pytest.fixture
def peer(make_peer):
    return make_peer()


@pytest.fixture
def launching(monkeypatch, tmp_path):
    """The module of the launch files, which leaves the end of a launch to remove what it writes."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with launch_files.stand_in(monkeypatch, tmp_path / "install") as module:
        yield module
