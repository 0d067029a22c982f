"""Vertical stiffness, progression and radii of a tire file, and values that no tire has."""

from pathlib import Path

import magic_formula
import pytest
from magic_formula import radii
from tire_texts import BASE, BASE_6_1, changed
from vehicle_files import line_of, refused

from vehicle_roll_sim import load_tire
from vehicle_roll_sim.vehicle.axle_tires import vertical_stiffness
from vehicle_roll_sim.vehicle.tire.vertical import compression

DATA = Path(magic_formula.__file__).parents[1] / "tire" / "data"
STRETCH = 1e-6
"""m: half a step of a central difference, whose relative error is below 1e-8."""


@pytest.mark.parametrize("name", ["mf61", "mf62"])
@pytest.mark.parametrize("change", [0.0, 0.2, -0.3])
def test_the_compression_carries_the_load_by_the_terms_of_the_file(name, change):
    """Upright, at standstill and without other forces."""
    c = load_tire(DATA / f"{name}.tir").coefficients
    p = magic_formula.Coefficients(c, "6.1")
    free = radii.free_radius(p, 0.0)
    for load in (500.0, c["FNOMIN"], 9000.0):
        radius = free - compression(c, load, change)
        assert radii.load_at(p, radius, 0.0, 0.0, 0.0, change, 0.0) == pytest.approx(load)


@pytest.mark.parametrize("name", ["mf52_full", "mf61", "mf62"])
def test_the_vertical_stiffness_is_the_slope_at_nominal_load(name):
    tire = load_tire(DATA / f"{name}.tir")
    c = tire.coefficients
    p, at = magic_formula.Coefficients(c, "6.1"), compression(c, c["FNOMIN"], 0.0)
    low, high = (
        radii.load_at(p, radii.free_radius(p, 0.0) - each, 0.0, 0.0, 0.0, 0.0, 0.0)
        for each in (at - STRETCH, at + STRETCH)
    )
    assert (high - low) / (2 * STRETCH) == pytest.approx(c["VERTICAL_STIFFNESS"], rel=1e-6)
    assert vertical_stiffness(tire, c["NOMPRES"] or None) == c["VERTICAL_STIFFNESS"]


def test_a_file_without_progression_is_linear_in_compression(base):
    c = base.coefficients
    expected = 1234.0 / c["VERTICAL_STIFFNESS"]
    assert compression(c, 1234.0, 0.0) == pytest.approx(expected, rel=1e-14)


WRONG = {
    "LMUX": ("-0.1", "at least 0"),
    "LATERAL_STIFFNESS": ("-1e5", "at least 0"),
    "Q_FZ2": ("500", "at most 56.25", "linear part"),  # (190000 * 0.3 / 3800)^2 / 4
    "PFZ1": ("-11", "a stiffness above 0 at INFLPRES"),
    "Q_RE0": ("0.4", "rolling radius 0.4 times"),
    "DREFF": ("20", "0.5 to 1.5 times"),
    "FREFF": ("9", "rolling radius 0.4"),
    "Q_V1": ("-0.6", "rolling radius at LONGVL 0.4 times"),
}


@pytest.mark.parametrize("key", WRONG)
def test_a_value_that_no_tire_has_is_refused(read, key):
    value, *said = WRONG[key]
    more = "BREFF = 8\n" if key == "DREFF" else ""
    text = changed({"Q_FZ2": "", "Q_V1": ""}, BASE_6_1) + f"[MORE]\n{more}{key} = {value}\n"
    with refused(line_of(text, key), key, *said):
        read(text)


DOUBTED = {
    "FNOMIN": ("3.8e6", "FORCE correct"),
    "LMUY": ("0", "no friction at any load"),
    "QSY1": ("0.5", "rolling resistance of 0.5"),
    "LMY": ("-1\nQSY1 = 0.01", "drives the wheel"),
}


@pytest.mark.parametrize("key", DOUBTED)
def test_a_value_that_is_probably_a_mistake_is_warned_of(read, key):
    value, said = DOUBTED[key]
    dropped = {name: "" for name in (key, "FZMIN", "FZMAX") if f"\n{name} =" in BASE}
    tire = read(changed(dropped) + f"[MORE]\n{key} = {value}\n")
    assert any(note.startswith("warning") and said in note for note in tire.notes)


def test_terms_of_the_vertical_force_that_are_not_simulated_are_named(read):
    text = changed({"Q_V1": "Q_V2 = 0.04\nQ_FCX = 0\nLCZ = 0.9"}, BASE_6_1)
    text += "[DEFLECTION_LOAD_CURVE]\n{pen fz}\n0 0.0\n0.01 2000.0\n"
    (note,) = [note for note in read(text).notes if "vertical force" in note]
    assert note.endswith("not simulated: Q_V2, LCZ, [DEFLECTION_LOAD_CURVE]")
    follows = (190000 * 0.3 / 3800) ** 2 - 4 * 15
    for q1, said in ((round(follows**0.5, 1), False), (11.0, True)):
        notes = read(BASE_6_1 + f"[MORE]\nQ_FZ1 = {q1}\n").notes
        assert any(note.endswith("not simulated: Q_FZ1") for note in notes) == said
    degressive = read(changed({"Q_FZ2": "Q_FZ2 = -4"}, BASE_6_1))
    assert any(note.endswith("not simulated: Q_FZ2") for note in degressive.notes)
    assert not [note for note in read(BASE + "[MORE]\nLCZ = 1\n").notes if "vertical" in note]
