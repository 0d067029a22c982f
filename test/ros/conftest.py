"""Fixtures: a domain for each test, processes and peers that end with it."""

import itertools
import os

import launch_files
import pytest
from peers import Peer, Process

RECORDING = ("recorder", "demo")
"""Programs that write bags."""
LARGEST_DOMAIN = 100
"""Above it, ports may meet those that the system hands out."""
WORKER = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
WORKERS = int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1"))
DOMAINS = range(WORKER + 1, LARGEST_DOMAIN + 1, WORKERS)
"""Those of this worker."""
_numbers = itertools.count(os.getpid())


@pytest.fixture(autouse=True)
def local_discovery(monkeypatch, tmp_path):
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "ros_log"))


@pytest.fixture(scope="session")
def new_domain():
    """new_domain(): a ROS domain that no other test of this run has at the same time."""
    return lambda: DOMAINS[next(_numbers) % len(DOMAINS)]


@pytest.fixture
def domain(new_domain):
    """The ROS domain of a test."""
    return new_domain()


@pytest.fixture
def start(domain):
    """start(module, *words): a process in the test's domain."""
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
    """The module of the launch files."""
    with launch_files.stand_in(monkeypatch, tmp_path / "install") as module:
        yield module
