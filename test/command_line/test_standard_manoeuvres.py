"""`run` with the manoeuvres of the standards: results and refusals."""

import numpy as np
import pytest

from vehicle_roll_sim.manoeuvres.catalogue import PAPER, STANDARD

OF_STANDARDS = [name for name in STANDARD if name not in PAPER]
CENTRES = ("--set", "front_roll_centre_height=0.1", "--set", "rear_roll_centre_height=0.15")
"""The roll centres of the reference vehicle, kept where they are when its c.g. is lowered."""
LOW = ("--set", "cg_height=0.55", *CENTRES)
REPORTED = {
    "slowly_increasing_steer": ("handwheel angle at 0.3 g",),
    "nhtsa_j_turn": ("handwheel angle at 0.3 g", "handwheel amplitude", "two-wheel lift"),
    "nhtsa_fishhook": ("handwheel amplitude", "two-wheel lift", "steering reversal"),
    "sine_with_dwell": ("yaw rate after 1.00 s", "lateral displacement", "verdict"),
    "iso_double_lane_change": ("cones struck", "deviation from the path", "verdict"),
    "iso_severe_double_lane_change": ("cones struck", "end of the track", "two-wheel lift"),
    "steady_state_circle": ("understeer gradient", "roll gradient"),
    "constant_radius_circle": ("understeer gradient", "roll gradient"),
    "constant_handwheel_circle": ("understeer gradient", "roll gradient"),
    "iso_step_steer": ("handwheel angle", "steady acceleration", "yaw rate response"),
    "braking_in_a_turn": ("radius of the turn", "mean deceleration", "yaw rate after 1 s"),
}
SMALLER = {
    "constant_radius_circle": ("--radius", "30", "--speed", "5", "--duration", "120"),
    "constant_handwheel_circle": ("--handwheel-angle", "80", "--speed", "5", "--duration", "120"),
}
"""Circles that take half the time; those of the standard have tests of their own."""


@pytest.mark.parametrize("name", OF_STANDARDS)
def test_a_manoeuvre_reports_what_it_is_driven_for(command, name):
    result = command("run", name, *LOW, *SMALLER.get(name, ()))
    assert (result.status, result.err) == (0, "")
    for label in REPORTED[name]:
        assert result.value[label]
        assert "not enough" not in result.value[label]
    assert "end" in result.value


@pytest.mark.parametrize("model", ["1c-iii", "8dof"])
@pytest.mark.parametrize("name", ["nhtsa_j_turn", "nhtsa_fishhook", "sine_with_dwell"])
def test_other_models_are_driven_through_them_too(command, name, model):
    result = command("run", name, "--model", model)
    assert (result.status, result.err) == (0, "")


def test_the_reference_vehicle_lifts_two_wheels_in_the_first_j_turn_and_a_low_one_does_not(command):
    assert command("run", "nhtsa_j_turn").number("two-wheel lift") > 1.155  # the turn is complete
    assert command("run", "nhtsa_j_turn", *LOW).value["two-wheel lift"] == "none"


def test_what_a_run_did_not_get_to_is_not_known(command):
    result = command("run", "sine_with_dwell", "--duration", "1")
    assert (result.status, result.err) == (0, "")
    for label in ("yaw rate after 1.00 s", "yaw rate after 1.75 s", "lateral displacement"):
        assert result.value[label].startswith("unknown")
    assert result.value["verdict"] == "failed"
    short = command("run", "slowly_increasing_steer", "--duration", "0.5")
    assert short.value["handwheel angle at 0.3 g"] == "not enough samples between 0.1 and 0.375 g"


def test_a_step_of_nothing_has_no_response(command):
    result = command("run", "iso_step_steer", "--lateral-acceleration", "0")
    assert (result.status, result.err) == (0, "")
    assert result.value["yaw rate response"] == "none, overshoot none"


def test_without_wheel_heights_it_says_so(command):
    result = command("run", "nhtsa_fishhook", "--model", "8dof")
    assert "unknown" in result.value["two-wheel lift"]


def test_the_angle_at_03g_may_be_given_and_scaled(rows):
    driven = rows("nhtsa_j_turn", "--steering-at-03g", "10", "--scalar", "-4", "--duration", "2")
    assert np.degrees(driven["steering"][-1]) == pytest.approx(-40.0 / 16.0, rel=1e-12)


def test_the_steering_ratio_is_that_of_the_vehicle(rows):
    words = ("nhtsa_j_turn", "--steering-at-03g", "10", "--duration", "2")
    driven = rows(*words, "--set", "steering_ratio=20")
    assert np.degrees(driven["steering"][-1]) == pytest.approx(80.0 / 20.0, rel=1e-12)


def test_a_fishhook_is_driven_every_10_ms_unless_told_otherwise(command):
    words = ("run", "nhtsa_fishhook", *LOW)
    plain, same = command(*words), command(*words, "--command-period", "0.01")
    finer = command(*words, "--command-period", "0.002")
    assert plain.out == same.out
    assert plain.value["steering reversal"] != finer.value["steering reversal"]


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("nhtsa_j_turn", "--scalar", "many"), ("--scalar", "from -100 to 100")),
        (("nhtsa_j_turn", "--scalar", "100"), ("handwheel angle", "at most 960 deg")),
        (("nhtsa_j_turn", "--amplitude", "3"), ("--amplitude",)),
        (("nhtsa_j_turn", "--back", "0"), ("--back", "from 0.001")),
        (("nhtsa_fishhook", "--reversal-roll-rate", "-1"), ("--reversal-roll-rate", "from 0")),
        (("nhtsa_fishhook", "--step", "0.003", "--duration", "3"), ("0.003 s",)),
        (("sine_with_dwell", "--frequency", "0"), ("--frequency", "from 0.001 to 100 Hz")),
        (("sine_with_dwell", "--steering-at-03g", "-1"), ("--steering-at-03g", "from 0")),
        (("slowly_increasing_steer", "--handwheel-angle", "1e4"), ("--handwheel-angle",)),
        (("iso_step_steer", "--lateral-acceleration", "12"), ("--lateral-acceleration", "12")),
        (("iso_double_lane_change", "--side", "up"), ("--side", "'up'", "one of left, right")),
        (("iso_double_lane_change", "--vehicle-width", "1"), ("--vehicle-width", "1.5 m")),
        (("iso_double_lane_change", "--preview-time", "0"), ("--preview-time", "from 0.05")),
        (("iso_severe_double_lane_change", "--driver-delay", "-1"), ("--driver-delay", "from 0")),
        (("iso_severe_double_lane_change", "--scalar", "3"), ("--scalar",)),
        (("constant_radius_circle", "--radius", "0"), ("radius", "at least 10 m")),
        (("constant_radius_circle", "--handwheel-angle", "30"), ("--handwheel-angle",)),
        (("constant_handwheel_circle", "--handwheel-angle", "1000"), ("at most 960 deg",)),
        (("constant_handwheel_circle", "--acceleration", "0"), ("--acceleration",)),
    ],
)
def test_what_is_wrong_is_refused_in_one_line(refused, words, named):
    refused(("run", *words, "--csv", "rows.csv"), *named)
