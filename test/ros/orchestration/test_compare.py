"""`compare`: runs without and with a controller; all started processes end."""

import contextlib
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from peers import PATIENCE, RACE_FOR_A_PORT

from vehicle_roll_sim.command_line.main import main
from vehicle_roll_sim.ros.orchestration import compare
from vehicle_roll_sim.runs.history import History

COMPARE = [sys.executable, "-m", "vehicle_roll_sim.ros.executables", "compare"]
SHORT = ("--duration", "1.6")
MINE = """
from vehicle_roll_sim.controller import Controller, run

class Mine(Controller):
    node_name = "mine"
    heard = ("motion", "lift_off")
    said = ("brake_torque_cmd",)

    def __init__(self):
        super().__init__()
        self.torque = self.parameter("torque", 0.0)

    def answer(self, motion, lift_off):
        return {answer}

run(Mine)
"""


@pytest.fixture
def script(tmp_path):
    """A script outside of the package with the answer that is given."""

    def write(answer="[0.0, self.torque, 0.0, 0.0]") -> str:
        path = tmp_path / "mine.py"
        path.write_text(MINE.format(answer=answer))
        return str(path)

    return write


@pytest.fixture
def begin(started, tmp_path, domain):
    """begin(*words): `compare` as a process in a folder of its own, which ends its nodes."""
    begun = []

    def begin_one(*words: str) -> subprocess.Popen:
        process = started(
            [*COMPARE, *words, "--domain", str(domain)],
            cwd=tmp_path,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        begun.append(process)
        return process

    yield begin_one
    for process in begun:
        if process.poll() is None:
            process.terminate()
            process.communicate(timeout=PATIENCE)


@pytest.fixture
def call(call_in_domain, nodes, tmp_path, monkeypatch):
    """call(*words): `compare` in this process, with nodes that are forked; as `ended`."""
    monkeypatch.chdir(tmp_path)
    usual = {each: signal.getsignal(each) for each in (signal.SIGINT, signal.SIGTERM)}

    def call_one(*words: str) -> tuple[int, str, list[str]]:
        result = call_in_domain("compare", compare.main, *words)
        assert nodes
        return result

    yield call_one
    for signum, handler in usual.items():
        signal.signal(signum, handler)


def ended(process: subprocess.Popen) -> tuple[int, str, list[str]]:
    """Status, what was printed, and lines of errors."""
    out, err = process.communicate(timeout=PATIENCE)
    return process.returncode, out, [s for s in err.splitlines() if RACE_FOR_A_PORT not in s]


def in_domain(domain: int) -> list[str]:
    """Processes that were started in a ROS domain: their ids and commands."""
    found = []
    for name in filter(str.isdecimal, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/environ", "rb") as file:
                variables = file.read().split(b"\0")
        except OSError:
            continue
        if f"ROS_DOMAIN_ID={domain}".encode() in variables and int(name) != os.getpid():
            with contextlib.suppress(OSError):
                found.append(f"{name} {Path('/proc', name, 'cmdline').read_bytes()!r}")
    return found


def test_a_script_from_anywhere_is_compared_in_figures_rows_and_a_picture(call, script, tmp_path):
    """The run without is the one that is driven offline, to the bit."""
    words = ("--parameter", "torque:=1500", "--csv", "without.csv", "with.csv")
    shown = ("--plot", "both.pdf", "--size", "170x200")
    status, out, err = call(script(), *SHORT, *words, *shown)
    assert (status, err) == (0, [])
    without, found = (History.read_csv(tmp_path / f"{name}.csv") for name in ("without", "with"))
    assert not without.command("brake_torque").any()
    assert set(found.command("brake_torque")[1:, 1]) == {1500.0}
    assert (tmp_path / "both.pdf").read_bytes().startswith(b"%PDF-")
    assert out.splitlines()[0].split() == ["without", "mine"]
    rows = {line.split(":")[0]: line.split()[-4:] for line in out.splitlines()}
    assert rows["rollover"][-2:] == ["none", "none"]
    speeds = [float(rows["forward speed at that time"][k]) for k in (0, 2)]
    assert speeds == pytest.approx([without["u"][-1], found["u"][-1]], abs=0.051)
    assert speeds[1] < speeds[0] - 0.5  # m/s: it has braked
    own = tmp_path / "offline.csv"
    offline = ["run", "j_turn", *SHORT, "--command-period", "0.01", "--csv", str(own)]
    assert main([*offline, "--with-commands"]) == 0
    expected = History.read_csv(own)
    for name in ("time", "roll", "u", "yaw_rate", "steering", "normal_force_lr"):
        assert without[name].tolist() == expected[name].tolist()
    assert without.commands.tolist() == expected.commands.tolist()


@pytest.mark.parametrize(
    ("answer", "words", "status", "line"),
    [
        ("{}['x']", (), 1, r"mine\.py ended with status 1: KeyError: 'x'"),
        ("[0.0] * 4", ("--simulator", "vehicle.cg_heigth:=1"), 2, "did you mean vehicle.cg_height"),
    ],
)
def test_a_node_that_ends_too_early_ends_it_and_is_named(call, script, answer, words, status, line):
    found, out, err = call(script(answer), *SHORT, *words)
    assert (found, out) == (status, "")
    assert re.search(f"^compare: error: .*{line}", err[-1])
    assert status == 1 or len(err) == 1


def test_ctrl_c_ends_every_node_that_it_started(begin, script, peer, domain):
    """Also a controller that answers nothing."""
    process = begin(script("__import__('time').sleep(60)"), *SHORT)
    peer.wait(lambda: "mine" in peer.node.get_node_names(), "the controller")
    process.send_signal(signal.SIGINT)
    status, out, err = ended(process)
    assert (status, out, err) == (130, "", ["compare: interrupted"])
    until = time.monotonic() + PATIENCE
    while left := in_domain(domain):  # processes of the domain's last user may still be ending
        assert time.monotonic() < until, left


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (("none.py",), "SCRIPT: 'none.py' is not allowed: the path of a script, or one of active_"),
        ((), "the following arguments are required: SCRIPT"),
        (("yaw_control", "--manoeuvre", "j_tum"), "MANOEUVRE: 'j_tum' is not allowed: one of"),
        (("yaw_control", "--speed", "fast"), "--speed: 'fast' is not allowed: a number"),
        (("yaw_control", "--simulator", "model"), "--simulator: 'model' is not allowed: NAME:=V"),
        (("yaw_control", "--simulator", "mode:=real_time"), "any parameter but mode and"),
        (("yaw_control", "--answers", "brakes"), "--answers: 'brakes' is not allowed: one of"),
        (("rollover_warning",), "publishes no command: a script whose `said` names a"),
        (("yaw_control", "--plot", "a.gif"), "--plot: 'a.gif' is not allowed"),
        (("yaw_control", "--plot", "a.png", "--size", "9x9"), "--size: '9x9' is not allowed: WID"),
        (("yaw_control", "--size", "170x200"), "--size: '170x200' is not allowed: together with"),
        (("yaw_control", "--csv", "a", "a"), "a path different from that of"),
        (("yaw_control", "--domain", "233"), "--domain: '233' is not allowed: a whole number"),
    ],
)
def test_wrong_words_are_refused_in_one_line_before_anything_is_started(capsys, words, line):
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(sys, "argv", ["compare", *words])
        patched.setattr(compare, "drive", None)
        patched.setattr(signal, "signal", lambda *_: None)
        assert compare.main() == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("compare: error: ")
    assert line in captured.err
    assert len(captured.err.splitlines()) == 1
