"""Active roll bars: the moment, its distribution, its limit; and the file of their gains."""

import dataclasses
import runpy
import sys

import pytest
from driven import REFERENCE, driven, filled_in

from vehicle_roll_sim import InputError
from vehicle_roll_sim.control_laws.gains_file import read_gains
from vehicle_roll_sim.control_laws.lqr_roll_bar import GAINS, GAINS_FILE, LqrRollBar
from vehicle_roll_sim.control_laws.roll_bar_design import design

STATE = {"v": -0.1, "yaw_rate": 0.1, "roll": 0.01, "roll_rate": 0.02}
"""Small: no corner is at its limit."""


@pytest.fixture(scope="module")
def script(request):
    """The script that designs the gains."""
    return request.config.rootpath / "examples" / "design_lqr_roll_bar.py"


def by_script(script, capsys, *words: str) -> tuple[int, str]:
    """The exit status of the script, and what it prints."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", [str(script), *words])
        with pytest.raises(SystemExit) as ended:
            runpy.run_path(str(script), run_name="__main__")
    said = capsys.readouterr()
    return ended.value.code, said.out + said.err


def test_the_forces_are_opposite_and_their_moment_is_that_of_the_gains():
    law = LqrRollBar(front_share=0.6, front_track=1.5, rear_track=1.4)
    lf, rf, lr, rr = law.forces(STATE)
    assert (lf, lr) == (-rf, -rr)
    moments = (rf - lf) / 2 * 1.5, (rr - lr) / 2 * 1.4
    expected = sum(getattr(law, g) * STATE[g.removesuffix("_gain")] for g in GAINS[1:])
    expected += law.lateral_velocity_gain * STATE["v"]
    assert sum(moments) == pytest.approx(expected)
    assert moments[0] / sum(moments) == pytest.approx(0.6)


def test_a_body_that_leans_to_the_right_is_pushed_up_on_the_right():
    upright = dict.fromkeys(STATE, 0.0)
    lf, rf, _, _ = LqrRollBar().forces(upright | {"roll": 0.01})
    assert rf > 0.0 > lf


def test_no_corner_exceeds_the_largest_force():
    forces = LqrRollBar().forces(STATE | {"roll": -1.0})
    assert forces == [3000.0, -3000.0, 3000.0, -3000.0]


def test_the_peak_roll_angle_of_the_step_steer_is_less_than_half_and_does_not_overshoot():
    manoeuvre = filled_in("step_steer", amplitude=2.0)
    without, found = (driven(manoeuvre, *laws)["roll"] for laws in ((), (LqrRollBar(),)))
    assert found.max() < 0.5 * without.max()
    assert without.max() > 1.1 * without[-1]
    assert found.max() < 1.02 * found[-1]


def test_the_gains_are_those_in_the_file_and_those_that_are_designed_again():
    assert read_gains(GAINS_FILE) == LqrRollBar()
    again = design(REFERENCE).law
    for name, value in dataclasses.asdict(LqrRollBar()).items():
        assert value == float(f"{getattr(again, name):.5g}"), name


def test_the_script_writes_the_file_and_no_other_bytes(script, capsys, tmp_path):
    file = tmp_path / "gains.yaml"
    assert by_script(script, capsys, "--output", str(file)) == (0, "")
    assert file.read_bytes() == GAINS_FILE.read_bytes()


def test_the_file_says_what_the_gains_are_for(script, capsys):
    status, text = by_script(script, capsys, "--speed", "30", "--set", "cg_height=0.6")
    assert status == 0
    assert "# vehicle: reference cg_height=0.6, model 1" in text
    assert "straight ahead at 30 m/s" in text


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (("--speed", "0.5"), "--speed: 0.5 is not allowed: a number from 1 to 100 m/s"),
        (("--moment-scale", "x"), "--moment-scale"),
        (("--vehicle", "nobody.yaml"), "nobody.yaml"),
        (("--model", "8dof"), "model: '8dof'"),
        (("--output", "/nowhere/gains.yaml"), "--output"),
        (("--sped", "3"), "did you mean --speed"),
    ],
)
def test_wrong_input_of_the_script_is_refused_in_one_line(script, capsys, words, problem):
    status, text = by_script(script, capsys, *words)
    assert status == 2
    assert problem in text
    assert text.count("\n") == 1


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (("roll_gain: 138380.0", ""), "roll_gain missing or unknown"),
        (("roll_gain:", "rol_gain:"), "rol_gain, roll_gain missing or unknown"),
        (("ros__parameters:", "parameters:"), "no parameters of the node"),
        (("front_share: 0.55", "front_share: 2.0"), "front_share: 2.0 is not allowed"),
        (("138380.0", "[1]"), "roll_gain"),
    ],
)
def test_a_wrong_gains_file_is_refused_in_one_line(tmp_path, change, problem):
    file = tmp_path / "gains.yaml"
    file.write_text(GAINS_FILE.read_text(encoding="utf-8").replace(*change), encoding="utf-8")
    with pytest.raises(InputError) as raised:
        read_gains(file)
    assert problem in str(raised.value)
    assert "\n" not in str(raised.value)
