"""The first start on a machine: the simulator says that it compiles, and clients wait."""

import fcntl
import shutil
import signal
import time

import pytest

from vehicle_roll_sim.model.compiled.code_cache import COMPLETE
from vehicle_roll_sim.model.compiled.jit import CACHE
from vehicle_roll_sim.ros.clients.simulator_client import PATIENCE
from vehicle_roll_sim.ros.simulator.compile_status import COMPILING
from vehicle_roll_sim.simulation.compilation import LOCK

pytestmark = [
    pytest.mark.skipif(CACHE is None, reason="only compiled code is cached"),
]
SHORT = ("step_steer", "--duration", "0.5")


@pytest.fixture
def compiling(tmp_path, monkeypatch):
    """The lock of a cache that nobody has noted as complete, held as by one that compiles."""
    folder = tmp_path / "cache" / CACHE.name
    shutil.copytree(CACHE, folder, ignore=shutil.ignore_patterns(COMPLETE, LOCK))
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(folder.parent))
    with (folder / LOCK).open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield lock


def wait_until_it_says_so(peer) -> None:
    def says_so() -> bool:
        heard = [s for _, each in peer.received["/diagnostics"] for s in each.status]
        return any(each.message == COMPILING for each in heard)

    peer.listen("/diagnostics")
    peer.wait(says_so, "the simulator to say that it compiles")


def test_a_manoeuvre_waits_for_longer_than_for_one_that_does_not_answer(start, peer, compiling):
    driver = start("manoeuvre", *SHORT)
    simulator = start("simulator")
    wait_until_it_says_so(peer)
    until = time.monotonic() + PATIENCE + 2.0
    peer.wait(lambda: time.monotonic() > until, "its patience to pass")
    assert driver.process.poll() is None
    fcntl.flock(compiling, fcntl.LOCK_UN)
    status, out, err = driver.finish()
    assert (status, err.count("is compiling the model")) == (0, 1)
    assert out.rstrip().endswith("complete")  # in real time, perhaps a period later than asked
    assert simulator.finish(signal.SIGINT)[0] == 0


@pytest.mark.parametrize("signum", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_a_simulator_that_compiles_and_one_that_waits_for_it(
    start, peer, compiling, signum
):
    simulator, driver = start("simulator"), start("manoeuvre", *SHORT)
    wait_until_it_says_so(peer)
    for node in (simulator, driver):
        status, _, err = node.finish(signum)
        assert status == 0
        assert "Traceback" not in err
