"""Nodes that are interrupted, disturbed or lack a library: one line, no orphan processes."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE
from std_srvs.srv import Trigger


def children_of(process: subprocess.Popen) -> list[int]:
    """Process ids of the children, as Linux lists them."""
    listed = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text()
    return [int(number) for number in listed.split()]


@pytest.mark.parametrize("signum", [signal.SIGINT, signal.SIGTERM])
def test_a_demo_that_is_interrupted_takes_its_nodes_along(start, tmp_path, signum):
    demo = start("demo", "--output", str(tmp_path / "run"))
    assert "J-turn" in demo.process.stdout.readline()  # simulator and recorder are up
    children = children_of(demo.process)
    assert len(children) >= 2
    status, out, err = demo.finish(signum)
    assert status == 130
    assert "Traceback" not in out + err
    assert not any(Path(f"/proc/{child}").exists() for child in children)
    assert (tmp_path / "run" / "bag" / "metadata.yaml").exists()


def test_a_manoeuvre_that_is_reset_by_somebody_else_says_so(start, peer):
    start("simulator")
    peer.listen("state", "applied_command")
    driver = start("manoeuvre", "j_turn")
    peer.wait(lambda: peer.newest("applied_command").data[1] > 0.0, "the manoeuvre to steer")
    peer.call(Trigger, "simulator/reset")
    status, _, err = driver.finish()
    assert status == 1
    assert "reset by another node" in err


def test_a_recorder_without_its_library_says_what_to_install(tmp_path):
    code = (
        "import sys; sys.modules['rosbags'] = None; sys.argv[0] = 'recorder';"
        "from vehicle_roll_sim.ros.clients.recorder import main; sys.exit(main())"
    )
    words = [sys.executable, "-c", code, "--output", str(tmp_path / "bag")]
    result = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE)
    assert result.returncode == 2
    assert len(result.stderr.splitlines()) == 1
    assert "pip install rosbags" in result.stderr
    assert not (tmp_path / "bag").exists()


def test_a_bag_that_vanishes_is_said_in_one_line(start, tmp_path):
    folder = tmp_path / "bag"
    recorder = start("recorder", "--output", str(folder))
    assert "recording to" in recorder.process.stdout.readline()
    for entry in folder.iterdir():
        entry.unlink()
    folder.rmdir()
    status, _, err = recorder.finish(signal.SIGINT)
    assert status == 1
    assert "Traceback" not in err
