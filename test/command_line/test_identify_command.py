"""`vehicle_roll_sim identify`: a log of a run gives its vehicle back; what is refused."""

import shutil

import pytest

from vehicle_roll_sim import load_vehicle, preset, run

pytest.importorskip("pint", reason="maps name units")
MAP = """\
columns:
  time: {column: time, unit: s}
  speed: {column: u, unit: m/s}
  steering: {column: steering, unit: rad}
  yaw_rate: {column: yaw_rate, unit: rad/s}
  lateral_acceleration: {column: lateral_acceleration, unit: m/s^2, frame: level}
  roll: {column: roll, unit: rad}
"""
QUICK = ("--step", "0.004", "--run-up", "0.5")
WORDS = ("identify", "turn.csv", "--map", "map.yaml")


@pytest.fixture(scope="module")
def turn(tmp_path_factory):
    """The file of a turn of a vehicle with a lower c.g."""
    path = tmp_path_factory.mktemp("turn") / "turn.csv"
    lower = preset().with_values({"cg_height": 0.72})
    run("step_steer", lower, speed=20.0, amplitude=2.0, duration=3.0).write_csv(path)
    return path


@pytest.fixture
def log(folder, turn):
    """This file and its map in the working folder."""
    (folder / "map.yaml").write_text(MAP, encoding="utf-8")
    shutil.copy(turn, folder)
    return folder


def test_a_run_gives_its_vehicle_back(command, log):
    outputs = ("--out", "car.yaml", "--profile", "cg_height", "--plot", "profile.svg")
    free = ("--free", "cg_height", "--sensors", "delay")
    result = command(*WORDS, *free, *QUICK, "--hold-out", "turn.csv", *outputs)
    assert (result.status, result.err) == (0, "")
    vehicle = load_vehicle(log / "car.yaml")
    # the step of the run was 1 ms, and its steering is interpolated between rows
    assert vehicle.cg_height == pytest.approx(0.72, abs=0.01)
    assert result.value["vehicle file"] == "car.yaml"
    assert result.value["held out, turn.csv"].startswith("accepted")
    assert "profile of cg_height" in result.value
    assert (log / "profile.svg").read_text(encoding="utf-8").startswith("<?xml")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--free", ""), "--free: missing: names of what is identified"),
        (("--free", "cg_hight"), "--free: 'cg_hight' is unknown: did you mean cg_height?"),
        (("--sensors", "bais"), "--sensors: 'bais' is unknown: did you mean bias?"),
        (("--free", "cg_height", "--prior", "cg_height=1"), "NAME=MEAN,SD"),
        (("--free", "cg_height", "--prior", "cg_height=1,0"), "--prior cg_height: "),
        (("--free", "cg_height", "--prior", "damping=1,1"), "--prior: 'damping' is unknown"),
        (("--free", "cg_height", "--profile", "damping"), "--profile: 'damping' is unknown"),
        (("--free", "cg_height", "--plot", "x.png"), "--plot: 'x.png' is not allowed: together"),
        (("--free", "cg_height", "--out", "no/x.yaml"), "--out: 'no/x.yaml' is not allowed"),
        (("turn.csv", "--free", "cg_height"), "LOG: 'turn.csv' is not allowed: each log once"),
        (("--free", "cg_height", "--begin", "9"), "--begin: "),
        (("--free", "cg_height", "--drive-by", "torques"), "--drive-by: "),
    ],
)
def test_what_is_wrong_is_refused_in_one_line_and_nothing_is_written(command, log, words, message):
    before = sorted(log.iterdir())
    result = command("identify", "turn.csv", *words, "--map", "map.yaml", *QUICK)
    assert (result.status, result.out) == (2, "")
    assert message in result.err
    assert result.err.count("\n") == 1
    assert sorted(log.iterdir()) == before
