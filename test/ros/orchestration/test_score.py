"""`score`: controllers in lockstep over a small catalogue; those that fail; all processes end."""

import dataclasses
import os
import re
import signal
import sys
import time
from pathlib import Path

import pytest
from peers import PATIENCE

from vehicle_roll_sim.manoeuvres.nhtsa import NHTSA_FISHHOOK
from vehicle_roll_sim.ros.orchestration import controller_processes, score
from vehicle_roll_sim.scoring import catalogue, report, spread
from vehicle_roll_sim.scoring.blocks import as_markdown
from vehicle_roll_sim.scoring.driven import Driven, drive_again, drive_alone
from vehicle_roll_sim.scoring.plan import Ladder, Setup
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_ANGLE, DEFAULT_STEP
from vehicle_roll_sim.simulation.options import options_for
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.shipped import vehicle_named

pytest.importorskip("rosbags", reason="the bag of the worst run needs the library rosbags")
pytestmark = pytest.mark.unmeasured
SHORT = dataclasses.replace(
    catalogue.TESTS["fishhook"],
    manoeuvre=dataclasses.replace(NHTSA_FISHHOOK, start=0.1, duration=0.8),
    quick=(35.0, 50.0),
)
MINE = """
from vehicle_roll_sim.controller import Controller, Topic, run

class Mine(Controller):
    node_name = "{name}"
    heard = ("state",)
    said = ("brake_torque_cmd",)
    sets = 0

    def answer(self, state):
        self.sets += 1
        time = state.data[0]
        {answer}

run(Mine)
"""
ANSWERS = {
    "steady": "return [float('nan') if time == 0.2 else 2e4, 900.0, 0.0, 0.0]",
    "dies": "return [0.0] * 4 if time < 0.2 else {}['x']",
    "twice": "self._say([0.0] * 4); return [0.0] * 4",
    "keeps": "return [float(self.sets), 0.0, 0.0, 0.0]",
    "hangs": "return [0.0] * 4 if time < 0.2 else __import__('time').sleep(600)",
}
"""What controllers do, by their names."""
STEERS = """
from vehicle_roll_sim.controller import Controller, Topic, run

class Steers(Controller):
    node_name = "steers"
    heard = (Topic("driver_steering", "std_msgs/msg/Float64"),)
    said = ("steering_cmd",)

    def answer(self, demand):
        return 0.5 * demand.data

run(Steers)
"""


BRAKES = """
from vehicle_roll_sim.controller import Controller, Topic, run

class Brakes(Controller):
    node_name = "brakes"
    heard = (Topic("driver_brake_torque", "std_msgs/msg/Float64MultiArray"),)
    said = ("brake_torque_cmd",)

    def answer(self, demand):
        return [0.5 * torque for torque in demand.data]

run(Brakes)
"""
SHORT_STOP = dataclasses.replace(
    catalogue.TESTS["split_friction"],
    manoeuvre=dataclasses.replace(
        catalogue.TESTS["split_friction"].manoeuvre, start=0.1, duration=0.3
    ),
    quick=(60.0,),
    at=catalogue.TESTS["step"].at,
)


PATIENCE_OF_SCORE = "20"
"""s: on a busy machine a controller may need some to end, or to answer its first set."""


@pytest.fixture
def scripts(tmp_path) -> dict[str, str]:
    paths = {}
    for name, answer in ANSWERS.items():
        path = tmp_path / f"{name}.py"
        path.write_text(MINE.replace("{name}", name).replace("{answer}", answer))
        paths[name] = str(path)
    (tmp_path / "steers.py").write_text(STEERS)
    return paths | {"steers": str(tmp_path / "steers.py")}


@pytest.fixture
def call(call_in_domain, monkeypatch):
    """call(*words): `score` in this process over two runs; status, output and lines of errors.

    Of the report it writes the text: test/scoring has the other files.
    """
    monkeypatch.setitem(catalogue.TESTS, "fishhook", SHORT)
    for name in spread.SPREAD.keys() - {spread.NOMINAL}:
        variant = dataclasses.replace(spread.SPREAD[name], is_quick=False)
        monkeypatch.setitem(spread.SPREAD, name, variant)
    monkeypatch.setattr(report, "write_report", write_text)

    def call_one(*words: str) -> tuple[int, str, list[str]]:
        return call_in_domain("score", score.main, *words, "--quick", "--only", "fishhook")

    return call_one


def test_the_drivers_brakes_add_to_those_of_a_controller_unless_it_hears_them(
    call, tmp_path, monkeypatch
):
    """And the run is driven on the road of the test."""
    monkeypatch.setitem(catalogue.TESTS, "fishhook", SHORT_STOP)
    own = "return [0.0, 100.0, 0.0, 0.0]"
    text = {"adds": MINE.replace("{name}", "adds").replace("{answer}", own), "hears": BRAKES}
    for name, script in text.items():
        (tmp_path / f"{name}.py").write_text(script)
    scripts, out = [str(tmp_path / f"{name}.py") for name in text], tmp_path / "out"
    status, said, _ = call(*scripts, "--patience", PATIENCE_OF_SCORE, "--out", str(out))
    assert status == 0, said
    for name, (before, braking) in {
        "adds": ([0.0, 100.0, 0.0, 0.0], [900.0, 1000.0, 450.0, 450.0]),
        "hears": ([0.0] * 4, [450.0, 450.0, 225.0, 225.0]),
    }.items():
        driven = kept(out, name, 60.0)
        torques = driven.commands["brake_torque"].tolist()
        assert torques == [before] * 10 + [braking] * 20, name
    assert driven.commands["steering"][-1] > 1e-4, "no side is slippery, so nothing is to steer"


def write_text(written: report.Report, folder: Path) -> None:
    text = as_markdown(report.TITLE, report.blocks_of(written))
    (folder / report.TEXT).write_text(text, encoding="utf-8")


def files_of(folder) -> dict[str, bytes]:
    files = (each for each in folder.rglob("*") if each.is_file())
    return {str(each.relative_to(folder)): each.read_bytes() for each in files}


def kept(folder, controller: str, level: float) -> Driven:
    name = Ladder("fishhook", "nominal", "left", ()).name(level)
    return Driven.from_bytes((folder / "runs" / f"{controller}-{name}.npz").read_bytes())


def test_controllers_are_scored_and_those_that_fail_have_a_row_that_says_why(
    call, scripts, tmp_path
):
    out = tmp_path / "out"
    words = [*scripts.values(), "rollover_warning", "--patience", PATIENCE_OF_SCORE]
    status, said, err = call(*words, "--out", str(out))
    assert (status, err) == (2, [])
    lines = {line.split(":")[0]: line for line in said.splitlines()}
    for name, why in {
        "dies": r"dies\.py ended with status 1: KeyError: 'x'",
        "twice": r"\d+ messages on brake_torque_cmd in answer to \d+ sets",
        "keeps": r"driven again, its first run differs: it keeps its state",
        "hangs": r"no message on brake_torque_cmd in answer to the set of 0\.2 s within 20 s",
    }.items():
        assert re.search(f"not scored: {why}", lines[name]), said
    text = (out / "report.md").read_text()
    assert text.count("not scored: ") == 4
    assert re.search(r"steady`: `brake_torque_cmd`: of \d+ messages 1 dropped, \d+ clamped", text)
    assert {each.name.partition("-")[0] for each in (out / "runs").iterdir()} >= {"steady"}
    assert not any("keeps" in each.name for each in (out / "runs").iterdir())

    vehicle = vehicle_named("reference")
    setup = Setup(vehicle, options_for(vehicle), DEFAULT_STEP, DEFAULT_ROLLOVER_ANGLE, Road(), 0.01)
    ladder = Ladder("fishhook", "nominal", "left", SHORT.quick)
    for level in SHORT.quick:
        alone = drive_alone(ladder, level, setup)
        warned = drive_again(ladder, level, setup, kept(out, "rollover_warning", level))
        assert warned.history.rows.tobytes() == alone.history.rows.tobytes()  # it only warns
        assert len(warned.warned) == len(alone.history.rows)
        assert warned.warned.any()
        steady = kept(out, "steady", level)
        assert {*steady.commands["brake_torque"][:, 1].tolist()} == {900.0}
        steered = kept(out, "steers", level).commands["steering"]
        turned = alone.history["steering"][1:20]  # before the reversal, which depends on the roll
        assert steered[:19].tolist() == (0.5 * turned).tolist()
        braked = drive_again(ladder, level, setup, steady).history
        assert braked["u"][-1] < alone.history["u"][-1] - 0.2  # m/s


def test_repeated_restarted_and_resumed_it_is_the_same_report(call, scripts, tmp_path):
    """A controller that keeps its state can be scored if it is started for every run."""
    folders = [tmp_path / name for name in ("one", "two")]
    for folder in folders:
        status, _, err = call(scripts["keeps"], "--restart", "--out", str(folder))
        assert (status, err) == (0, [])
    assert files_of(folders[0]) == files_of(folders[1])
    first = kept(folders[0], "keeps", SHORT.quick[0])
    assert first.commands["brake_torque"][:, 0].tolist() == list(range(1, len(first.commands) + 1))
    (tmp_path / "one" / "runs" / "keeps-fishhook-nominal-left-35.npz").unlink()
    status, _, _ = call(scripts["keeps"], "--restart", "--out", str(folders[0]))
    assert status == 0
    assert files_of(folders[0]) == files_of(folders[1])
    status, _, err = call(scripts["keeps"], "--out", str(folders[1]))
    assert status == 2
    assert "driven again, its first run differs" in err[-1]
    assert os.listdir(folders[1] / "runs") == []
    status, _, err = call(scripts["steady"], "--out", str(folders[0]))
    assert status == 2
    assert re.search("^score: error: --out: .* has another score: a new folder$", err[-1])


def test_a_launch_file_is_started_by_ros2_and_all_that_it_starts_ends_with_it(
    tmp_path, monkeypatch
):
    """`ros2` is a stand-in that goes on to wait for a process of its own, and ignores SIGTERM."""
    launch, ros2 = tmp_path / "mine.launch.py", tmp_path / "ros2"
    launch.write_text("")
    ros2.write_text(f"#!/bin/sh\ntrap '' TERM\nsleep 600 &\necho $* $! > {tmp_path}/said\nwait\n")
    ros2.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    monkeypatch.setattr(controller_processes, "PATIENCE", 0.1)
    found = controller_processes.controller_of(
        f"{launch} gain:=2", (), ("brake_torque_cmd", "rollover_warning"), "CONTROLLER"
    )
    assert (found.name, found.files) == ("mine", (ros2, launch))
    processes = controller_processes.Processes(found, tmp_path)
    processes.start()
    try:
        until = time.monotonic() + PATIENCE
        said = tmp_path / "said"
        while not (said.exists() and said.read_text().endswith("\n")):
            assert time.monotonic() < until
        *words, child = said.read_text().split()
        assert words == ["launch", str(launch), "gain:=2"]
        processes.check()
    finally:
        processes.stop()
    assert not processes.are_running
    wait_for_end_of(child)


def stat_of(process: str) -> list[str]:
    """State (Z: ended), parent and so on of a process; empty if it is gone."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return []


def wait_for_end_of(process: str) -> None:
    until = time.monotonic() + PATIENCE
    while stat_of(process)[:1] not in ([], ["Z"]):
        assert time.monotonic() < until, f"waited {PATIENCE} s in vain for process {process} to end"


def test_ctrl_c_ends_every_process_and_what_was_driven_is_kept(
    opened, scripts, peer, tmp_path, domain
):
    out = tmp_path / "out"
    words = [scripts["hangs"], "--quick", "--out", str(out), "--domain", str(domain)]
    process = opened([sys.executable, "-m", "vehicle_roll_sim.ros.executables", "score", *words])
    peer.wait(lambda: "hangs" in peer.node.get_node_names(), "the controller")
    known = filter(str.isdecimal, os.listdir("/proc"))
    children = [each for each in known if stat_of(each)[1:2] == [str(process.pid)]]
    assert children
    process.send_signal(signal.SIGINT)
    said, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, said) == (130, "")
    assert err.splitlines()[-1] == "score: interrupted"
    assert sorted(files_of(out)) == ["score.json"]
    for each in children:  # the list of known nodes can keep one that was killed
        wait_for_end_of(each)


@pytest.mark.parametrize(
    ("words", "line"),
    [
        ((), "the following arguments are required: CONTROLLER"),
        (("nobody",), "CONTROLLER: there is no program nobody: a script, a launch file"),
        (("none.py",), "CONTROLLER: 'none.py' is not allowed: the path of a script, or one of"),
        (("none.launch.py",), "CONTROLLER: 'none.launch.py' is not allowed: the path of a launch"),
        (("true",), "--answers: missing: the topics on which true answers each set"),
        (("true 'a",), "CONTROLLER: No closing quotation: a command line"),
        (("true", "--answers", "speed_cmd"), "--answers: 'speed_cmd' is not allowed: one of"),
        (("yaw_control + ",), "names, scripts or commands, separated by +"),
        (("yaw_control", "yaw_control"), "CONTROLLER: 'yaw_control' is not allowed: controllers"),
        (("yaw_control", "--only", "fishook"), "did you mean fishhook?"),
        (("yaw_control", "--only", "frequency", "--quick"), "a test of this size"),
        (("yaw_control", "--patience", "0"), "--patience: 0.0 is not allowed: a number from 1"),
        (("yaw_control", "--patience", "long"), "--patience: 'long' is not allowed: a number"),
        (("yaw_control", "--simulator", "mode:=real_time"), "any parameter but mode and"),
        (("yaw_control", "--simulator", "model"), "--simulator: 'model' is not allowed: NAME:=V"),
        (("yaw_control", "--domain", "233"), "--domain: '233' is not allowed: a whole number"),
        (("true", "--answers", "brake_cmd", "--parameter", "a:=1"), "together with a script"),
    ],
)
def test_wrong_words_are_refused_in_one_line_before_anything_is_started(
    capsys, monkeypatch, tmp_path, words, line
):
    monkeypatch.setattr(sys, "argv", ["score", *words, "--out", str(tmp_path / "out")])
    monkeypatch.setattr(score, "context", None)
    assert score.main() == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("score: error: ")
    assert line in captured.err
    assert len(captured.err.splitlines()) == 1
    assert os.listdir(tmp_path) == []
