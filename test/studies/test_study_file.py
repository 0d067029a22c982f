"""Study files: what is accepted, and one line for each kind of mistake."""

from fractions import Fraction

import numpy as np
import pytest

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.studies.factors import Grid, Levels, LogNormal, Normal, Triangular, Uniform
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.study_file import study_of

GOOD = """\
manoeuvre: nhtsa_fishhook
vehicle: suv
model: 1b
fixed: {manoeuvre.duration: 6, options.euler_terms: true}
factors:
  vehicle.cg_height: {distribution: normal, mean: 0.7, sd: 0.05, lowest: 0.5}
  vehicle.sprung_mass: {distribution: lognormal, mean: 2000, sd: 100}
  front_tire.LMUY: {distribution: triangular, lowest: 0.7, mode: 1, highest: 1.2}
  road.bank: {distribution: uniform, lowest: -0.05, highest: 0.05}
  manoeuvre.speed: {lowest: 10, highest: 20, count: 3}
  options.tire_moments: ["on", "off"]
correlations:
  - [vehicle.cg_height, vehicle.sprung_mass, 0.6]
design: sobol
runs: 16
seed: 1
events:
  rollover: {metric: rollover_time}
  much_roll: {metric: peak_roll, above: 0.2}
"""
"""Lines 6 to 11 are the factors."""
SEARCH = "search: {factor: road.grade, event: rollover, lowest: 0, highest: 0.2, resolution: 0.1}"
RARE = "rare: {event: much_roll}"


def read(tmp_path, text: str):
    path = tmp_path / "study.yaml"
    path.write_text(text, encoding="utf-8")
    return study_of(Source.of_file(path))


def test_a_study_file_says_what_is_fixed_varied_and_drawn(tmp_path):
    study = read(tmp_path, GOOD)
    assert study.fixed == {
        "options.model": "1b",
        "manoeuvre.duration": 6.0,
        "options.euler_terms": True,
    }
    kinds = [type(factor) for factor in study.factors.values()]
    assert kinds == [Normal, LogNormal, Triangular, Uniform, Grid, Levels]
    assert study.gridded["manoeuvre.speed"] == (10.0, 15.0, 20.0)
    assert (study.points, study.correlation[0, 1]) == (16 * 3 * 2, 0.6)


def test_the_speed_hold_may_be_the_one_adapted_to_the_vehicle(tmp_path):
    study = read(tmp_path, GOOD.replace("manoeuvre.duration: 6", "manoeuvre.speed_hold: null"))
    assert study.fixed["manoeuvre.speed_hold"] is None


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("manoeuvre.speed: {lowest", "manoeuvre.speed_hold: [0, null]\n  x: {lowest", "2: missing"),
        ("manoeuvre: nhtsa_fishhook", "", "manoeuvre: missing: one of step_steer"),
        ("nhtsa_fishhook", "fishook", "line 1: manoeuvre: 'fishook' is unknown"),
        (
            "  manoeuvre.speed:",
            "  tire.LMUY: [1]\n  manoeuvre.speed:",
            "line 8: factors: front_tire.LMUY: front_tire.LMUY together with tire.LMUY: either all",
        ),
        ("suv", "suw", "line 2: vehicle: "),
        ("vehicle: suv", "vehicle:", "line 2: vehicle: missing"),
        ("lowest: 0.5}", "lowest: 2}", "lowest: 2.0 is not allowed: bounds with a probability"),
        ("mean: 2000, sd: 100", "mean: 1.0e-99, sd: 1.0e+99", "sd: draws lie between"),
        ("highest: 20, count", "highest: 10.0000000000001, count", "that can be told apart"),
        ("above: 0.2", "above: -0.2", "above: -0.2 is not allowed: a number from 0"),
        ("much_roll: {", "peak_roll: {", "a name that is not that of a metric"),
        ("design:", "desing:", "line 14: desing: 'desing' is unknown: did you mean design?"),
        ("1b", "9", "line 3: model: '9' is not allowed: one of"),
        ("euler_terms", "eular_terms", "line 4: fixed: options.eular_terms: 'eular_terms' is"),
        ("manoeuvre.duration", "integration.x", "'integration' is unknown: one of vehicle, tire"),
        ("duration: 6", "duration: -6", "line 4: fixed: manoeuvre.duration: -6 is not allowed"),
        ("vehicle.cg_height: {", "vehicle.cg_hight: {", "did you mean cg_height?"),
        ("front_tire.LMUY", "front_tire.LMYU", "line 8: factors: front_tire.LMYU: 'LMYU' is"),
        ("road.bank: {", "payload.1.mass: {", "the vehicle has 0 masses of payload"),
        ("road.bank: {", "payload.x.mass: {", "the number of a mass in the vehicle file"),
        ("road.bank: {", "road: {", "such as road.bank"),
        ("distribution: normal", "distribution: norml", "did you mean normal?"),
        ("mean: 0.7, ", "", "line 6: factors: vehicle.cg_height: mean: missing"),
        ("sd: 0.05", "sd: 0", "line 6: factors: vehicle.cg_height: sd: 0.0 is not allowed"),
        ("sd: 0.05", "sigma: 0.05", "line 6: factors: vehicle.cg_height: sigma: 'sigma' is unk"),
        ("lowest: -0.05", "lowest: 0.06", "bank: highest: 0.05 is not allowed: more than lowest"),
        ("lowest: -0.05", "lowest: -7", "line 9: factors: road.bank: lowest: -7.0 is not allowed"),
        ("mode: 1,", "mode: 2,", "line 8: factors: front_tire.LMUY: mode: 2.0 is not allowed"),
        ("count: 3", "count: 2.5", "line 10: factors: manoeuvre.speed: count: 2.5 is not allowed"),
        ("count: 3", "step: 3", "factors: manoeuvre.speed: step: 'step' is unknown"),
        ('["on", "off"]', '["on", "yes"]', "line 11: factors: options.tire_moments: 2: 'yes'"),
        ('["on", "off"]', '["on", "on"]', "on is given twice: each value once"),
        ('["on", "off"]', "[]", "0 values: 1 to 10000 values"),
        ('["on", "off"]', "{lowest: 0, highest: 1, count: 2}", "tire_moments is not a number"),
        ('["on", "off"]', "on", "line 11: factors: options.tire_moments: "),
        ("manoeuvre.duration: 6", "road.bank: 0.1", "road.bank is also fixed, at 0.1"),
        ("0.6]", "1.6]", "line 13: correlations: 1: 1.6 is not allowed: a number between -1"),
        ("sprung_mass, 0.6]", "sprung_mas, 0.6]", "did you mean vehicle.sprung_mass?"),
        ("sprung_mass, 0.6]", "sprung_mass]", "[factor, factor, correlation]"),
        (
            "0.6]",
            "0.9]\n  - [road.bank, vehicle.cg_height, 0.9]\n"
            "  - [road.bank, vehicle.sprung_mass, -0.9]",
            "line 12: correlations: the smallest eigenvalue of their matrix is -0.8",
        ),
        ("design: sobol", "design: grid", "line 14: design: factors have distributions: one of"),
        ("design: sobol\n", "", "design: missing: factors with distributions need one of"),
        ("design: sobol", "design: sobel", "did you mean sobol?"),
        ("design: sobol", "design: saltelli", "correlations: saltelli needs independent factors"),
        ("runs: 16", "runs: 17", "line 15: runs: 17 is not allowed: a power of 2 with design"),
        ("runs: 16", "runs: 1048576", "runs: 1048576 is not allowed"),
        ("runs: 16", "runs: 524288", "factors: 3145728 runs: at most 1000000 in all"),
        ("runs: 16\n", "", "runs: missing"),
        ("seed: 1\n", "", "seed: missing: a whole number, from which all draws follow"),
        ("seed: 1", "seed: 1.5", "line 16: seed: 1.5 is not allowed: a whole number"),
        ("rollover_time", "rolover_time", "line 18: events: rollover: metric: 'rolover_time' is"),
        ("above: 0.2", "over: 0.2", "line 19: events: much_roll: over: 'over' is unknown"),
        (", above: 0.2", "", "events: much_roll: above: missing: peak_roll needs a bound"),
        ("above: 0.2", "above: 0.2, below: 1", "either above or below, not both"),
        ("much_roll:", "much roll/:", "a name of letters, digits and underscores"),
        ("seed: 1", "seed: 1\noutputs: [peak_rol]", "outputs: 1: 'peak_rol' is unknown: did you"),
        ("seed: 1", f"seed: 1\n{SEARCH.replace('road.grade', 'road.bank')}", "not among factors"),
        ("seed: 1", f"seed: 1\n{SEARCH.replace('rollover', 'roll')}", "did you mean rollover?"),
        ("seed: 1", f"seed: 1\n{SEARCH.replace('0.2', '-1')}", "highest: -1.0 is not allowed"),
        ("seed: 1", f"seed: 1\n{SEARCH.replace('0.2', '2')}", "search: highest: 2.0 is not allo"),
        ("seed: 1", f"seed: 1\n{RARE}", "only factors with a distribution, for rare"),
        ("seed: 1", f"seed: 1\n{RARE.replace('much_roll', 'rollover')}", "an event with a bound"),
        ("seed: 1", "seed: 1\nseed: 2", "duplicate key 'seed' in line 17"),
    ],
)
def test_a_mistake_is_named_with_its_place_and_what_is_allowed(tmp_path, before, after, message):
    assert GOOD.count(before) == 1
    with pytest.raises(InputError) as raised:
        read(tmp_path, GOOD.replace(before, after))
    assert str(raised.value).count("\n") == 0
    assert "study.yaml: " in str(raised.value) or "study file" in str(raised.value)
    assert message in str(raised.value)


def test_a_model_is_one_of_those_there_are(study):
    with pytest.raises(InputError, match=r"options.model: 2: 7 is not allowed: one of 1, 1a"):
        study(factors={"options.model": [1, 7]})


def test_correlations_of_what_is_not_drawn_are_refused(study):
    with pytest.raises(InputError, match="correlations: no factor has a distribution: none, or"):
        study(correlations=[["vehicle.cg_height", "manoeuvre.speed", 0.5]])


@pytest.mark.parametrize(
    "changes",
    [
        {"model": "8dof"},
        {"factors": {"options.model": ["1", "8dof-rigid-tires"]}},
    ],
)
def test_a_search_for_an_event_that_a_model_does_not_have_is_refused(study, changes):
    bounds = {"lowest": 10, "highest": 20, "resolution": 1}
    search = {"factor": "manoeuvre.speed", "event": "two_wheel_lift", **bounds}
    factors = {"vehicle.cg_height": [0.5]}
    with pytest.raises(InputError, match="event: two_wheel_lift is unknown to model 8dof"):
        study(**{"factors": factors, **changes}, search=search)
    assert study(factors=factors, search=search | {"event": "rollover"}, model="8dof").search


@pytest.mark.parametrize("name", ["runs", "seed"])
def test_what_only_draws_need_is_refused_without_them(study, name):
    with pytest.raises(InputError, match=f"{name}: nothing is drawn"):
        study(**{name: 3})


@pytest.mark.parametrize("value", [object(), b"x", np.array([1, 2]), {(1, 2): 3}])
@pytest.mark.parametrize("key", ["correlations", "step", "events", "search"])
def test_a_value_from_python_that_json_does_not_have_is_refused_by_its_name(study, key, value):
    with pytest.raises(InputError, match=f"^study: {key}: "):
        study(**{key: value})


def test_a_number_of_any_type_is_kept_as_a_number(study):
    found = study(factors={"manoeuvre.speed": [Fraction(31, 2), np.int64(16), np.float32(0.5)]})
    assert found.identity["study"]["factors"] == {"manoeuvre.speed": [15.5, 16, 0.5]}
