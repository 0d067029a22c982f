"""`run --model`: every model and option through the manoeuvres, undefined combinations refused."""

import pytest

from vehicle_roll_sim.manoeuvres.catalogue import PAPER
from vehicle_roll_sim.simulation.options import MODELS

OPTIONS = (
    ["--no-roll-centre"],
    ["--tire-normal-to-ground"],
    ["--tire-normal-to-ground", "--no-roll-centre"],
    ["--link-load-transfer", "asymmetric"],
    ["--link-load-transfer", "asymmetric", "--tire-normal-to-ground"],
    ["--euler-terms"],
    ["--steady-state-slip"],
)
UNDEFINED = (
    ["--model", "1a", "--tire-normal-to-ground"],
    ["--model", "1b", "--link-load-transfer", "asymmetric"],
    ["--model", "1c-iv", "--euler-terms"],
    ["--model", "8dof", "--no-roll-centre"],
    ["--model", "8dof", "--euler-terms"],
    ["--no-roll-centre", "--link-load-transfer", "asymmetric"],
)


@pytest.mark.parametrize("manoeuvre", PAPER)
@pytest.mark.parametrize("model", MODELS)
def test_every_model_runs_through_every_manoeuvre_of_the_source(command, model, manoeuvre):
    result = command("run", manoeuvre, "--model", model)
    assert (result.status, result.err) == (0, "")
    ended = ("rolled over", "complete")
    assert result.out.splitlines()[-1].endswith(ended)


@pytest.mark.parametrize("options", OPTIONS, ids=" ".join)
@pytest.mark.parametrize("manoeuvre", PAPER)
def test_every_option_of_model_1_runs_and_changes_the_result(command, manoeuvre, options):
    result = command("run", manoeuvre, *options)
    assert (result.status, result.err) == (0, "")
    assert result.out != command("run", manoeuvre).out


@pytest.mark.parametrize("words", UNDEFINED, ids=" ".join)
def test_a_combination_that_is_not_defined_is_refused(command, words):
    result = command("run", "step_steer", *words)
    assert result.status == 2
    assert len(result.err.splitlines()) == 1
    assert any(word in result.err for word in words if word.startswith("--"))


def test_an_unknown_model_is_refused_with_those_there_are(command):
    result = command("run", "step_steer", "--model", "9dof")
    assert result.status == 2
    assert "1c-iii" in result.err
