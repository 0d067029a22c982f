"""Units of tire files: every name of Adams, and coefficients by their dimension."""

import math

import pytest
from tire_texts import BASE, BASE_6_1, changed
from vehicle_files import line_of, refused

from vehicle_roll_sim.vehicle.tire.units import UNITS

ROUNDING = 1e-15
LENGTHS = {"mm": 1e-3, "Millimeter": 1e-3, "CM": 1e-2, "inch": 0.0254, "in": 0.0254, "foot": 0.3048}
FORCES = {"kN": 1e3, "knewton": 1e3, "pound_force": 4.4482216152605, "LBF": 4.4482216152605}
FORCES |= {"kg_force": 9.80665, "kpound_force": 4448.2216152605, "dyne": 1e-5}


@pytest.mark.parametrize("unit", LENGTHS)
def test_lengths_stiffnesses_and_speeds_follow_the_unit_of_length(read, unit):
    metres = LENGTHS[unit]
    c = read(changed({"LENGTH": f"LENGTH = '{unit}'"})).coefficients
    assert c["UNLOADED_RADIUS"] == pytest.approx(0.3 * metres, rel=ROUNDING)
    assert c["VERTICAL_STIFFNESS"] == pytest.approx(190_000 / metres, rel=ROUNDING)
    assert c["LONGVL"] == pytest.approx(15 * metres, rel=ROUNDING)
    assert c["FNOMIN"] == 3800.0


@pytest.mark.parametrize("unit", FORCES)
def test_loads_and_stiffnesses_follow_the_unit_of_force(read, unit):
    newtons = FORCES[unit]
    c = read(changed({"FORCE": f"FORCE = '{unit}'"})).coefficients
    assert c["FNOMIN"] == pytest.approx(3800 * newtons, rel=ROUNDING)
    assert (c["FZMIN"], c["FZMAX"]) == pytest.approx((200 * newtons, 9000 * newtons), rel=ROUNDING)
    assert c["VERTICAL_STIFFNESS"] == pytest.approx(190_000 * newtons, rel=ROUNDING)
    assert (c["PKY1"], c["PDX1"]) == (-18.0, 1.05)  # without dimension


@pytest.mark.parametrize(("unit", "value"), [("degree", math.pi / 180), ("DEG", math.pi / 180)])
@pytest.mark.parametrize("largest", [20, 85])
def test_of_angles_only_the_ranges_follow_the_unit(read, unit, value, largest):
    lines = {
        "ANGLE": f"ANGLE = '{unit}'",
        "ALPMIN": f"ALPMIN = {-largest}",
        "ALPMAX": f"ALPMAX = {largest}\n[INCLINATION_ANGLE_RANGE]\nCAMMIN = -5\nCAMMAX = 6",
    }
    c = read(changed(lines)).coefficients
    ranges = [c[name] for name in ("ALPMIN", "ALPMAX", "CAMMIN", "CAMMAX")]
    assert ranges == pytest.approx(
        [-largest * value, largest * value, -5 * value, 6 * value], rel=1e-15
    )
    assert (c["PHY1"], c["PKY1"]) == (0.002, -18.0)


PRESSURES = {"bar": 1e5, "kPa": 1e3, "psi": 6894.757293168361, "pascal": 1.0, "kpascal": 1e3}


@pytest.mark.parametrize("unit", PRESSURES)
def test_pressures_have_their_unit_or_that_of_force_and_length(read, unit):
    lines = {"TIME": f"TIME = 'sec'\nPRESSURE = '{unit}'", "INFLPRES": "INFLPRES = 2.2"}
    lines["NOMPRES"] = "NOMPRES = 2"
    c = read(changed(lines, BASE_6_1)).coefficients
    assert c["INFLPRES"] == pytest.approx(2.2 * PRESSURES[unit], rel=1e-12)
    lines = {"LENGTH": "LENGTH = 'mm'", "INFLPRES": "INFLPRES = 0.22", "NOMPRES": "NOMPRES = 0.2"}
    c = read(changed(lines, BASE_6_1)).coefficients
    assert (c["INFLPRES"], c["NOMPRES"]) == pytest.approx((220_000, 200_000), rel=1e-12)


def test_a_radius_that_no_tire_has_is_noted(read):
    tire = read(changed({"LENGTH": "LENGTH = 'mm'"}))
    assert any("warning: UNLOADED_RADIUS" in note and "0.0003 m" in note for note in tire.notes)
    assert not any("warning" in note for note in read(BASE).notes)


def test_units_that_are_converted_are_noted(read, base):
    tire = read(
        changed({"FORCE": "FORCE = 'kN'", "FNOMIN": "FNOMIN = 3.8", "FZMAX": "", "FZMIN": ""})
    )
    assert any(note == "converted to SI units: FORCE = kN (line 8)" for note in tire.notes)
    assert not any("SI units" in note for note in base.notes)


@pytest.mark.parametrize("quantity", UNITS)
def test_every_name_of_a_unit_is_read_in_any_letters(read, quantity):
    """Names after the units commands of Adams; some are longer or shorter than there."""
    for value, names in UNITS[quantity].items():
        assert value > 0.0
        for name in names:
            line = f"{quantity} = '{name.upper()}'"
            known = quantity != "PRESSURE"
            text = changed({quantity: line} if known else {"TIME": f"TIME = 's'\n{line}"})
            assert read(text).coefficients["PKY1"] == -18.0


@pytest.mark.parametrize(
    ("quantity", "unit"),
    [("LENGTH", "furlong"), ("FORCE", "volt"), ("ANGLE", "grad"), ("MASS", ""), ("TIME", "year")],
)
def test_a_unit_that_is_not_understood_is_refused(read, quantity, unit):
    text = changed({quantity: f"{quantity} = '{unit}'"})
    with refused(line_of(text, quantity), quantity, repr(unit), "one of"):
        read(text)
