"""Models and options: valid combinations, and the flags for the equations."""

import dataclasses
import itertools

import numpy as np
import pytest
from signals import everything, turn

from vehicle_roll_sim import Condition, InputError, Options, Simulation, preset
from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.simulation.options import MODELS

EIGHT_DOF = [model for model in MODELS if model.startswith("8dof")]
SIMPLIFIED = [model for model in MODELS if model not in ("1", "2", *EIGHT_DOF)]
MODEL_1_ONLY = {
    "tire_normal_to_ground": True,
    "link_load_transfer": "asymmetric",
    "euler_terms": True,
}
CHOICES = {
    "no_roll_centre": (False, True),
    "tire_normal_to_ground": (False, True),
    "link_load_transfer": ("symmetric", "asymmetric"),
    "euler_terms": (False, True),
    "steady_state_slip": (False, True),
}
COMBINATIONS = [
    dict(zip(CHOICES, values, strict=True)) for values in itertools.product(*CHOICES.values())
]


def has_a_link_to_split(combination: dict) -> bool:
    """Each side's own link load transfer takes a roll centre."""
    return not combination["no_roll_centre"] or combination["link_load_transfer"] == "symmetric"


DEFINED = [
    *({"model": "1", **values} for values in COMBINATIONS if has_a_link_to_split(values)),
    *(
        {"model": model, "no_roll_centre": none, "steady_state_slip": steady}
        for model in SIMPLIFIED
        for none in (False, True)
        for steady in (False, True)
    ),
    *(
        {"model": model, "steady_state_slip": steady}
        for model in ("2", *EIGHT_DOF)
        for steady in (False, True)
    ),
]


def flags(options: Options) -> set[str]:
    """Names of the forms of terms that the equations are told to take."""
    record = options.record()
    assert record.shape == (1,)
    return {name for name in record.dtype.names if record[0][name]}


def test_an_option_that_the_equations_do_not_have_is_not_ignored_in_silence():
    made = dataclasses.make_dataclass(
        "More", [("no_such_term", bool, True)], bases=(Options,), frozen=True
    )
    with pytest.raises(ValueError, match="no_such_term"):
        made().record()


@pytest.mark.parametrize("model", ["2", *SIMPLIFIED, *EIGHT_DOF])
@pytest.mark.parametrize("name", MODEL_1_ONLY)
def test_simplified_models_refuse_the_options_of_model_1(model, name):
    with pytest.raises(InputError) as refusal:
        Options(model=model, **{name: MODEL_1_ONLY[name]})
    assert refusal.value.field == name
    text, lacking = str(refusal.value), f"model {model} does not have it"
    if MODEL_1_ONLY[name] is True:
        assert text == f"{name}: {lacking}: an option of model 1"
    else:
        assert (
            text
            == f"{name}: {MODEL_1_ONLY[name]!r} is not allowed: an option of model 1; {lacking}"
        )


@pytest.mark.parametrize(
    "combination", [values for values in COMBINATIONS if not has_a_link_to_split(values)], ids=str
)
def test_without_a_roll_centre_there_is_no_asymmetric_link_load_transfer(combination):
    with pytest.raises(InputError, match="no roll centre") as refusal:
        Options(**combination)
    assert refusal.value.field == "link_load_transfer"


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("model", "3"),
        ("model", "1A"),
        ("model", ""),
        ("model", 1.5),
        ("link_load_transfer", "Symmetric"),
        ("no_roll_centre", "yes"),
        ("tire_normal_to_ground", 1),
        ("euler_terms", None),
        ("steady_state_slip", "no"),
    ],
)
def test_a_value_that_is_none_of_the_choices_is_refused_by_name(name, value):
    with pytest.raises(InputError) as refusal:
        Options(**{name: value})
    assert refusal.value.field == name


@pytest.mark.parametrize("values", DEFINED, ids=lambda values: "-".join(map(str, values.values())))
def test_every_defined_combination_runs(values):
    simulation = Simulation(preset(), Options(**values))
    assert simulation.step(turn(4.0), 0.5) is Condition.RUNNING
    assert np.isfinite(simulation.model_state).all()
    assert simulation.state.roll > 0.01  # rad, to the outside of the turn
    assert simulation.options == Options(**values).for_vehicle(preset())


def test_the_default_is_model_1_of_the_source_on_tires_with_transient_slip():
    options = Options()
    assert dataclasses.asdict(options) == {
        "model": "1",
        "no_roll_centre": False,
        "tire_normal_to_ground": False,
        "link_load_transfer": "symmetric",
        "euler_terms": False,
        "steady_state_slip": False,
        "wheel_gyroscopics": False,
        "tire_moments": "auto",
        "contact_patch_shift": "auto",
        "body_contact": False,
    }
    assert flags(options) == set()
    named, unnamed = Simulation(preset(), options), Simulation(preset())
    for simulation in (named, unnamed):
        simulation.step(turn(4.0), 0.5)
    assert everything(named) == everything(unnamed)


@pytest.mark.parametrize("model", ["2", *EIGHT_DOF])
def test_models_without_fixed_roll_centres_of_an_axle_refuse_to_do_without(model):
    with pytest.raises(InputError, match="does not have it") as refusal:
        Options(model=model, no_roll_centre=True)
    assert refusal.value.field == "no_roll_centre"


@pytest.mark.parametrize("model", MODELS)
def test_the_record_has_just_the_flags_of_the_model(model):
    assert flags(Options(model=model)) == set(MODELS[model])


@pytest.mark.parametrize("model", ["1", *SIMPLIFIED])
def test_no_roll_centre_is_one_more_flag(model):
    assert flags(Options(model=model, no_roll_centre=True)) == {*MODELS[model], "no_roll_centre"}


@pytest.mark.parametrize("model", MODELS)
def test_steady_state_slip_is_one_more_flag_of_every_model_and_its_slips_are_no_states(model):
    transient, steady = Options(model=model), Options(model=model, steady_state_slip=True)
    assert flags(steady) == {*MODELS[model], "steady_state_slip"}
    assert transient.states == (*steady.states, "longitudinal_slip", "lateral_slip")


def test_model_1_given_as_a_number_is_the_model_of_that_name():
    """As command lines and parameter files of ROS read it."""
    assert flags(Options(model=1)) == set()
    assert Options(model=1) == Options()


def test_the_record_has_a_flag_for_each_option_of_model_1():
    assert flags(Options(tire_normal_to_ground=True)) == {"tire_normal_to_ground"}
    assert flags(Options(euler_terms=True)) == {"euler_terms"}
    assert flags(Options(link_load_transfer="asymmetric")) == {"asymmetric_link_load_transfer"}


def test_each_simplified_model_has_the_flags_of_the_one_before_it():
    assert set(MODELS["1"]) < set(MODELS["1a"]) < set(MODELS["1b"])
    for model in ("1c-i", "1c-ii", "1c-iii", "1c-iv", "1b-static-strut", "1b-mass-lumped"):
        assert len(set(MODELS[model]) - set(MODELS["1b"])) == 1
        assert set(MODELS["1b"]) < set(MODELS[model])
    assert set(MODELS["1b-static-strut"]) < set(MODELS["1b-no-strut"])
    assert set(MODELS["1a"]) < set(MODELS["1b-turning-kept"]) < set(MODELS["1b"])


def test_every_option_says_what_it_is_and_what_it_may_be():
    declared = parameters_of(Options)
    assert set(declared) == {field.name for field in dataclasses.fields(Options)}
    assert all(known.description for known in declared.values())
    assert declared["model"].choices == tuple(MODELS)
