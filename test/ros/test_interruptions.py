"""Nodes that are interrupted, disturbed or lack a library: one line, no orphans."""

import signal
import subprocess
import sys

from std_srvs.srv import Trigger


def names_of(peer) -> set[str]:
    return set(peer.node.get_node_names())


def test_a_demo_that_is_interrupted_takes_its_nodes_along(start, peer, tmp_path):
    nodes = {"simulator", "recorder", "manoeuvre"}
    for number, signum in enumerate((signal.SIGINT, signal.SIGTERM)):
        demo = start("demo", "--output", str(tmp_path / str(number)))
        peer.wait(lambda: nodes <= names_of(peer), "the nodes of the demo")
        status, out, err = demo.finish(signum)
        assert status == 130
        assert "Traceback" not in out + err
        peer.wait(lambda: not nodes & names_of(peer), "the end of the nodes")
        assert (tmp_path / str(number) / "bag" / "metadata.yaml").exists()


def test_a_manoeuvre_that_is_reset_by_somebody_else_says_so(start, peer):
    start("simulator")
    peer.listen("state", "applied_command")
    driver = start("manoeuvre", "j_turn")
    peer.wait(lambda: peer.newest("applied_command").data[1] > 0.0, "the manoeuvre to steer")
    peer.call(Trigger, "simulator/reset")
    status, _, err = driver.finish()
    assert status == 1
    assert "reset by somebody else" in err


def test_a_recorder_without_its_library_says_what_to_install(tmp_path):
    code = (
        "import sys; sys.modules['rosbags'] = None; sys.argv[0] = 'recorder';"
        "from vehicle_roll_sim.ros.recorder import main; sys.exit(main())"
    )
    words = [sys.executable, "-c", code, "--output", str(tmp_path / "bag")]
    result = subprocess.run(words, capture_output=True, text=True, timeout=60)
    assert result.returncode == 2
    assert len(result.stderr.splitlines()) == 1
    assert "pip install rosbags" in result.stderr
    assert not (tmp_path / "bag").exists()


def test_a_bag_that_vanishes_is_said_in_one_line(start, peer, tmp_path):
    folder = tmp_path / "bag"
    recorder = start("recorder", "--output", str(folder))
    peer.wait(lambda: "recorder" in names_of(peer), "the recorder")
    for entry in folder.iterdir():
        entry.unlink()
    folder.rmdir()
    status, _, err = recorder.finish(signal.SIGINT)
    assert status == 1
    assert "Traceback" not in err
