"""USE_MODE, FE_METHOD, TYRESIDE, and files that lack combined slip or a longitudinal force."""

import math

import pytest
from tire_texts import BASE, BASE_6_1, changed
from vehicle_files import line_of, refused

from vehicle_roll_sim.vehicle.tire import curves
from vehicle_roll_sim.vehicle.tire.keys import COMBINED, LONGITUDINAL

NO_COMBINED = dict.fromkeys(COMBINED, "")
NO_FX = dict.fromkeys((*LONGITUDINAL, "PDX2", "PEX1", "PKX2", "PKX3"), "")
NO_FX |= {"RBX1": "", "RBX2": "", "RCX1": ""}


def mode(value) -> dict[str, str]:
    return {"USE_MODE": f"USE_MODE = {value}"}


@pytest.mark.parametrize("value", ["4", "14", "24", "124", "-4", "5", "15", "14.0"])
def test_modes_of_combined_slip(read, value):
    assert read(changed(mode(value))).combined


@pytest.mark.parametrize("value", ["3", "13", "-13", "113"])
@pytest.mark.parametrize("lines", [{}, NO_COMBINED])
def test_without_combined_slip_its_coefficients_may_be_missing(read, value, lines):
    tire = read(changed(mode(value) | lines))
    assert not tire.combined
    assert any(f"USE_MODE = {value}" in note and "locked wheel" in note for note in tire.notes)


@pytest.mark.parametrize("missing", [COMBINED, COMBINED[:2], COMBINED[3:]])
@pytest.mark.parametrize("value", ["14", "4"])
def test_missing_coefficients_of_combined_slip_are_refused_with_what_switches_it_off(
    read, missing, value
):
    with refused(*missing, "RBX1 = RCX1 = RBY1 = RCY1 = 0", "USE_MODE = 3"):
        read(changed(mode(value) | dict.fromkeys(missing, "")))


def test_coefficients_of_combined_slip_that_are_0_switch_it_off_and_are_noted(read):
    tire = read(changed({name: f"{name} = 0" for name in COMBINED}))
    assert sum("warning: combined slip is off" in note for note in tire.notes) == 2
    assert not any("combined" in note for note in read(BASE).notes)


@pytest.mark.parametrize("value", ["0", "1", "10", "21", "6", "9", "1004", "4.5", "many", "nan"])
def test_modes_without_side_force_and_unknown_ones_are_refused(read, value):
    text = changed(mode(value))
    with refused(line_of(text, "USE_MODE"), "USE_MODE", value):
        read(text)


@pytest.mark.parametrize("answer", ["YES", "yes", "Yes"])
@pytest.mark.parametrize("weights", [{}, {"RBY1": "RBY1 = 0", "RCY1": "RCY1 = 0"}])
def test_a_friction_ellipse_is_refused(read, answer, weights):
    text = changed({"VXLOW": f"FE_METHOD = '{answer}'"} | weights)
    with refused(line_of(text, "FE_METHOD"), "FE_METHOD", answer, "friction ellipse", "NO"):
        read(text)


def test_without_a_friction_ellipse_or_combined_slip_fe_method_has_no_effect(read, base):
    assert read(changed({"VXLOW": "FE_METHOD = 'NO'"})) == base
    assert not read(changed({"VXLOW": "FE_METHOD = 'YES'"} | mode(3))).combined
    with refused("FE_METHOD", "'MAYBE'", "YES or NO"):
        read(changed({"VXLOW": "FE_METHOD = 'MAYBE'"}))


SIDES = {"LEFT": "left", "'right'": "right", "Symmetric": "symmetric", "'UNKNOWN'": "left"}


@pytest.mark.parametrize("given", [*SIDES, "unknown", "'Unknown'"])
def test_the_side_is_read_and_what_is_assumed_is_said(read, given):
    tire = read(changed({"TYRESIDE": f"TYRESIDE = {given}"}))
    assert tire.side == SIDES.get(given, "left")
    assumed = "unknown" in given.lower()
    assert any("taken as LEFT" in note for note in tire.notes) == assumed


def test_without_a_side_it_is_taken_as_left_and_said(read):
    tire = read(changed({"TYRESIDE": ""}))
    assert tire.side == "left"
    assert "TYRESIDE is not given: taken as LEFT" in tire.notes


@pytest.mark.parametrize("given", ["middle", "both", "l"])
def test_a_side_that_no_vehicle_has_is_refused(read, given):
    text = changed({"TYRESIDE": f"TYRESIDE = '{given}'"})
    with refused(line_of(text, "TYRESIDE"), "TYRESIDE", given, "SYMMETRIC or UNKNOWN"):
        read(text)


@pytest.mark.parametrize(
    ("given", "used"), [("LEFT", "right"), ("RIGHT", "left"), ("UNKNOWN", "right")]
)
def test_a_negative_mode_uses_the_tire_of_the_other_side(read, given, used):
    tire = read(changed(mode(-14) | {"TYRESIDE": f"TYRESIDE = '{given}'"}))
    assert tire.side == used
    assert any("other side" in note for note in tire.notes)


def test_a_symmetric_tire_has_no_ply_steer_or_conicity(read):
    tire = read(changed({"TYRESIDE": "TYRESIDE = 'SYMMETRIC'"}))
    assert tire.coefficients["PHY1"] == 0.0
    assert any("PHY1 dropped" in note for note in tire.notes)


LATERAL_ONLY = {
    "missing": changed(NO_FX),
    "zeros": changed({name: f"{name} = 0" for name in NO_FX}),
    "mode 2": changed(mode(2)),
    "mode 12, zeros": changed(mode(12) | {name: f"{name} = 0.0" for name in NO_FX}),
    "6.1": changed(NO_FX | {"INFLPRES": "INFLPRES = 200000"}, BASE_6_1),
}


@pytest.mark.parametrize("kind", LATERAL_ONLY)
def test_a_file_of_side_force_alone_is_refused_with_what_helps(read, kind):
    with refused(*LONGITUDINAL, "longitudinal: from_lateral"):
        read(LATERAL_ONLY[kind])


@pytest.mark.parametrize("kind", LATERAL_ONLY)
def test_the_stand_in_for_its_longitudinal_force_is_the_side_force(read, kind):
    """The same curve over slip ratio as over slip angle, and the same stiffness near nominal."""
    tire = read(LATERAL_ONLY[kind], longitudinal="from_lateral")
    c = tire.coefficients
    at = c["FNOMIN"]
    for slip in (0.01, 0.05, 0.2, 0.6):
        assert curves.curve(c, "X", at).force(slip) == pytest.approx(
            -curves.curve(c, "Y", at).force(slip), rel=1e-12
        )
    step = 1e-4 * at
    for load in (at - step, at, at + step):
        stiffness = curves.slip_stiffness(c, load)
        assert stiffness == pytest.approx(-curves.cornering_stiffness(c, load), rel=1e-7)
    assert curves.slip_stiffness(c, 3 * at) > 0.0
    assert c["RBX1"] > 0.0
    assert (c["RBY1"], c["RCY1"]) == (7.5, 1.04)
    assert any("isotropic" in note and "not measured" in note for note in tire.notes)


def test_the_stand_in_brings_typical_weights_where_a_file_has_none(read):
    none = NO_FX | dict.fromkeys((*COMBINED, "RBY2"), "")
    tire = read(changed(none), longitudinal="from_lateral")
    assert all(tire.coefficients[name] > 0.0 for name in COMBINED)
    uncombined = read(changed(none | mode(3)), longitudinal="from_lateral")
    assert not uncombined.combined


def test_a_file_with_a_longitudinal_force_keeps_it(read, base):
    assert read(BASE, longitudinal="from_lateral") == base
    with refused("longitudinal", "'isotropic'", "from_lateral"):
        read(BASE, longitudinal="isotropic")


def test_the_slip_stiffness_follows_the_pressure_as_the_cornering_stiffness_does(read):
    text = changed(NO_FX, BASE_6_1)
    near = changed({"INFLPRES": "INFLPRES = 200100"}, text)
    c = read(near, longitudinal="from_lateral").coefficients
    at = c["FNOMIN"]
    assert math.isclose(
        curves.slip_stiffness(c, at), -curves.cornering_stiffness(c, at), rel_tol=1e-6
    )
