"""A vehicle file names the model of its vehicle, which counts unless another is asked for."""

import pytest
from vehicle_files import REFERENCE_TIR, REFERENCE_YAML, refused, write

from vehicle_roll_sim import Options, Simulation
from vehicle_roll_sim.command_line.main import main
from vehicle_roll_sim.messages.urdf import urdf
from vehicle_roll_sim.offline.linearizing import linearize
from vehicle_roll_sim.simulation.options import options_for
from vehicle_roll_sim.vehicle.vehicle_file import load_vehicle, preset

SHORT = ("run", "step_steer", "--duration", "0.5")


@pytest.fixture
def vehicle_from(tmp_path):
    write(tmp_path, "reference.tir", REFERENCE_TIR)
    return lambda content: load_vehicle(write(tmp_path, "some.yaml", content))


@pytest.fixture
def file(vehicle_from, tmp_path):
    """The path of a vehicle file that names model 2."""
    vehicle_from(REFERENCE_YAML + 'model: "2"\n')
    return tmp_path / "some.yaml"


@pytest.mark.parametrize("spelt", ["2", '"2"'])
def test_simulations_of_the_vehicle_have_its_model(vehicle_from, spelt):
    vehicle = vehicle_from(REFERENCE_YAML + f"model: {spelt}\n")
    assert (vehicle.model, preset().model) == ("2", "1")
    assert Simulation(vehicle).options.model == "2"
    assert Simulation(vehicle.with_values({"cg_height": 0.7})).options.model == "2"
    assert Simulation(vehicle, Options()).options.model == "1"
    assert options_for(vehicle, model="8dof").model == "8dof"
    assert urdf(vehicle) == urdf(vehicle, Options(model="2")) != urdf(vehicle, Options())
    assert "lateral_slip_lf" in linearize(vehicle, speed=20.0).state_names


def test_run_follows_it_unless_told_otherwise_and_says_so(file, capsys):
    for words, model in (((), "2"), (("--model", "1a"), "1a")):
        assert main([*SHORT, "--vehicle", str(file), *words]) == 0
        assert capsys.readouterr().out.splitlines()[0].split() == ["model:", model]


def test_an_option_that_its_model_does_not_have_is_refused(file, capsys):
    assert main([*SHORT, "--vehicle", str(file), "--euler-terms"]) == 2
    assert "model 2 does not have it" in capsys.readouterr().err


def test_a_model_that_does_not_exist_is_refused_with_its_line(vehicle_from, tmp_path):
    text = REFERENCE_YAML + "model: 3\n"
    with refused(f"{tmp_path / 'some.yaml'}: line {text.count(chr(10))}: model", "'3'", "8dof"):
        vehicle_from(text)
