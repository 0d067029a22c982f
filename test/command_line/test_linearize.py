"""`linearize`: matrices and poles of a model about steady driving, and refusals."""

import subprocess
import sys

import numpy as np
import pytest
from patience import PATIENCE

from vehicle_roll_sim import Options, preset
from vehicle_roll_sim.analysis.linear_model import linearize
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.simulation.options import MODELS

SPEED = 50 / 3.6
"""m/s"""
NAMES = {
    *("A", "B", "C", "D", "state_names", "input_names", "output_names"),
    *("trim_state", "trim_input", "trim_output"),
}


@pytest.fixture
def written(command, folder):
    """Runs `linearize` with the given words and reads the arrays of its file."""

    def call(*words) -> dict[str, np.ndarray]:
        result = command("linearize", *words, "--npz", "model.npz")
        assert (result.status, result.err) == (0, "")
        assert result.value["NPZ"] == "model.npz"
        with np.load(folder / "model.npz", allow_pickle=False) as read:
            return dict(read)

    return call


def poles_in(out: str) -> np.ndarray:
    """The poles of the table, both of a pair."""
    rows = [line.split() for line in out.partition("  states\n")[2].splitlines()[1:] if line]
    poles = []
    for row in rows:
        swing = row[1].lstrip("±")
        poles += [complex(float(row[0]), sign * float(swing)) for sign in (1, -1)]
        if row[1] == "0":
            poles.pop()
    return np.sort_complex(poles)


def test_without_options_it_is_the_reference_vehicle_straight_ahead_at_50_km_h(written):
    arrays = written()
    expected = linearize(find_trim(preset(), speed=SPEED))
    assert set(arrays) == NAMES
    for name in "ABCD":
        assert np.array_equal(arrays[name], getattr(expected, name.lower()))
    assert tuple(arrays["state_names"]) == expected.state_names
    assert arrays["trim_state"] == pytest.approx(expected.trim_state)
    assert not arrays["trim_output"][3]


def test_the_table_has_every_pole_once_with_what_moves(command):
    result = command("linearize", "--steering", "3")
    assert (result.status, result.err) == (0, "")
    model = linearize(find_trim(preset(), speed=SPEED, steering=np.radians(3)))
    poles = np.sort_complex(np.linalg.eigvals(model.a).round(4))
    assert poles_in(result.out) == pytest.approx(poles, abs=2e-4)
    (roll,) = [line for line in result.out.splitlines() if "  roll, v, roll_rate" in line]
    frequency, damping, time_constant = map(float, roll.split()[2:5])
    assert frequency == pytest.approx(0.934, abs=1e-3)
    assert damping == pytest.approx(0.388, abs=1e-3)
    assert time_constant == pytest.approx(0.439, abs=1e-3)


def test_a_speed_that_nothing_holds_is_neutral_and_has_no_time_constant(command):
    rows = command("linearize").out.partition("  states\n")[2].splitlines()
    assert rows[1].split() == ["0.0000", "0", "0.0000", "-", "-", "u"]


def test_the_steady_state_is_the_one_that_was_asked_for(command, written):
    words = ("--speed", "20", "--lateral-acceleration", "-3")
    result = command("linearize", *words)
    assert result.number("speed") == pytest.approx(20.0)
    assert result.number("lateral acceleration") == pytest.approx(-3.0)
    assert result.number("roll angle") < -1.0
    arrays = written("--speed", "20", f"--steering={result.number('steering')}")
    names = list(arrays["output_names"])
    assert arrays["trim_output"][names.index("lateral_acceleration")] == pytest.approx(-3, abs=1e-3)


@pytest.mark.parametrize("model", [model for model in MODELS if model != "1c-iii"])
def test_every_model_but_one_is_linearised(written, model):
    arrays = written("--model", model, "--steering", "2")
    count = len(arrays["state_names"])
    assert count == (17 if model.startswith("8dof") else 29)
    assert np.isfinite(arrays["A"]).all()


@pytest.mark.parametrize(
    ("words", "options"),
    [
        (("--steady-state-slip",), {"steady_state_slip": True}),
        (("--no-roll-centre",), {"no_roll_centre": True}),
        (("--tire-normal-to-ground",), {"tire_normal_to_ground": True}),
        (("--link-load-transfer", "asymmetric"), {"link_load_transfer": "asymmetric"}),
        (("--euler-terms",), {"euler_terms": True}),
    ],
)
def test_options_of_the_model_are_those_of_run(written, words, options):
    arrays = written("--steering", "2", *words)
    trim = find_trim(preset(), Options(**options), speed=SPEED, steering=np.radians(2))
    assert np.array_equal(arrays["A"], linearize(trim).a)


def test_options_of_the_vehicle_are_those_of_run(written):
    arrays = written("--set", "cg_height=0.7")
    trim = find_trim(preset().with_values({"cg_height": 0.7}), speed=SPEED)
    assert np.array_equal(arrays["A"], linearize(trim).a)


REFUSED = {
    "both turns": (("--steering", "1", "--lateral-acceleration", "1"), "not together"),
    "steering": (("--steering", "61"), "--steering", "from -60 to 60 deg"),
    "acceleration": (("--lateral-acceleration", "31"), "from -30 to 30 m/s^2"),
    "speed": (("--speed", "101"), "--speed", "from 0 to 100 m/s"),
    "standing": (("--speed", "0"), "--speed", "0.0", "from 1 to 100 m/s"),
    "slow": (("--speed", "3", "--steady-state-slip"), "--speed", "from 3.5 to 100 m/s"),
    "too tight": (("--steering", "12"), "--steering: 12.0", "at most", "lifts or slides"),
    "too hard": (("--lateral-acceleration", "9"), "--lateral-acceleration: 9.0", "at most 7"),
    "no turn": (("--model", "1c-iii"), "--model", "1c-iii"),
    "undefined": (("--model", "8dof", "--no-roll-centre"), "--no-roll-centre", "8dof"),
    "a slope": (("--grade", "0.1"), "--grade"),
    "no number": (("--speed", "fast"), "--speed", "fast"),
    "misspelt": (("--steerin", "1"), "did you mean --steering?"),
    "no folder": (("--npz", "none/model.npz"), "--npz", "none"),
    "empty name": (("--npz", ""), "--npz", "the name of a file"),
    "set": (("--set", "sprung_mass=-1"), "--set sprung_mass"),
    "set for another model": (
        ("--set", "front_toe_change=0.1", "--model", "8dof"),
        "--set front_toe_change: 0.1",
        "14 DOF",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_wrong_is_one_line(refused, case):
    words, *expected = REFUSED[case]
    file = () if "--npz" in words else ("--npz", "model.npz")
    refused(("linearize", *words, *file), *expected)


def test_a_value_of_the_vehicle_file_is_refused_with_its_line(command, refused, folder):
    command("template", "car.yaml")
    with (folder / "car.yaml").open("a") as file:
        file.write("front_toe_change: 0.1\n")
    line = len((folder / "car.yaml").read_text().splitlines())
    words = ("linearize", "--vehicle", "car.yaml", "--model", "8dof")
    refused(words, f"car.yaml: line {line}: front_toe_change: 0.1", "14 DOF")


def test_a_full_disk_leaves_no_file(command, folder, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    result = command("linearize", "--npz", "model.npz")
    assert (result.status, result.out) == (1, "")
    assert "No space left on device" in result.err
    assert len(result.err.splitlines()) == 1
    assert not any(folder.iterdir())


def test_help_names_its_options(command, capsys):
    with pytest.raises(SystemExit) as end:
        command("linearize", "--help")
    assert end.value.code == 0
    text = capsys.readouterr().out
    for word in ("--speed", "--steering", "--lateral-acceleration", "--model", "--set", "--npz"):
        assert word in text


def test_the_other_commands_do_not_wait_for_the_root_finder():
    program = (
        "import sys; from vehicle_roll_sim.command_line import main;"
        "print('scipy.optimize' in sys.modules, 'linearize' in main.COMMANDS)"
    )
    words = [sys.executable, "-c", program]
    result = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE, check=True)
    assert result.stdout.split() == ["False", "True"]
