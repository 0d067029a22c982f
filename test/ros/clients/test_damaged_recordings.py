"""A recorder that is killed or whose disk is full: remaining data; other nodes unaffected."""

import resource
import signal
import time

import pytest
from patience import PATIENCE
from recordings import heard_so_far, read_bag
from std_srvs.srv import Trigger

pytest.importorskip("rosbags", reason="bags need the library rosbags")

from vehicle_roll_sim.bags.reading import recorded_runs
from vehicle_roll_sim.bags.replay import replay
from vehicle_roll_sim.bags.unindexed_reader import BagReader
from vehicle_roll_sim.simulation.description import described

pytestmark = pytest.mark.unmeasured

LAST_SECOND = 1_000_000_000
"""ns"""
REPLAYED = {"/simulation_description", "/applied_command", "/state"}
"""What a replay needs."""
A_FEW_SECONDS = 3.0
"""s of recording: several times what is kept back."""


@pytest.fixture
def bag(tmp_path):
    return tmp_path / "bag"


def stamps_in(bag) -> set[int]:
    """When the states in a bag were sent (ns), also while it is being recorded."""
    with BagReader(bag) as reader:
        states = [each for each in reader.connections if each.topic == "/state"]
        return {stamp for _, stamp, _ in reader.messages(states)}


@pytest.fixture
def recorder(start, peer, bag):
    """A recorder beside a simulator, which has recorded a few seconds after a reset.

    The peer listens after it only: what it then hears is of no time before.
    """
    start("simulator")
    recorder = start("recorder", "--output", str(bag))
    peer.wait(lambda: heard_so_far(bag).keys() >= REPLAYED, "the recorder to hear it")
    peer.call(Trigger, "simulator/reset")
    peer.listen("state")
    first = peer.newest("state").data[0]
    peer.wait(lambda: peer.newest("state").data[0] > first + A_FEW_SECONDS, "a few seconds")
    return recorder


def test_of_a_recorder_that_was_killed_all_but_the_last_second_can_be_read(recorder, peer, bag):
    recorder.process.kill()
    killed_at = time.time_ns()
    recorder.process.wait()
    found = stamps_in(bag)
    sent = [stamp for stamp, _ in peer.received["state"]]
    sent = [stamp for stamp in sent if min(found) <= stamp < killed_at - LAST_SECOND]
    assert len(sent) > 100
    assert set(sent) <= found
    assert len(read_bag(bag)["/state"]) == len(found)  # so says another library
    run = recorded_runs(bag)[-1]
    assert replay(run, described(run.description).simulation).is_exact


def test_a_full_disk_ends_the_recorder_with_one_line_and_nobody_else(recorder, peer, bag):
    limit = next(bag.glob("*.mcap")).stat().st_size  # the file can grow no more
    resource.prlimit(recorder.process.pid, resource.RLIMIT_FSIZE, (limit, limit))
    peer.wait(lambda: recorder.process.poll() is not None, "the end of the recorder")
    status, _, err = recorder.finish()
    assert status == 1
    assert len(err.splitlines()) == 1
    assert err.startswith("recorder: error: ")
    last = peer.current("state").data[0]
    peer.wait(lambda: peer.newest("state").data[0] > last + 0.1, "the simulator to go on")
    assert read_bag(bag)["/state"]


def test_a_recorder_that_nobody_reads_records(start, peer, bag):
    recorder = start("recorder", "--output", str(bag))
    recorder.process.stdout.close()
    start("simulator")
    peer.wait(lambda: "/state" in heard_so_far(bag), "the recorder to hear")
    recorder.process.send_signal(signal.SIGTERM)
    assert recorder.process.wait(PATIENCE) == 0
    assert read_bag(bag)["/state"]


def test_a_recorder_does_not_touch_what_is_there(start, bag):
    bag.mkdir()
    (bag / "metadata.yaml").write_text("mine")
    status, _, err = start("recorder", "--output", str(bag)).finish(signum=None)
    assert (status, len(err.splitlines())) == (2, 1)
    assert "a folder that does not exist yet" in err
    assert [(file.name, file.read_text()) for file in bag.iterdir()] == [("metadata.yaml", "mine")]


def test_a_recorder_that_nobody_talks_to_closes_an_empty_bag(start, peer, bag):
    recorder = start("recorder", "--output", str(bag))
    assert "recording to" in recorder.process.stdout.readline()
    assert recorder.finish(signal.SIGTERM)[0] == 0
    assert read_bag(bag) == {}
