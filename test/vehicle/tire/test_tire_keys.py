"""Keys of tire files: all that change forces are read or refused, none is lost."""

import pytest
from tire_texts import BASE, BASE_6_1, changed
from vehicle_files import line_of, refused

from vehicle_roll_sim import Tire
from vehicle_roll_sim.model.tire.coefficients import COEFFICIENTS as OF_EQUATIONS
from vehicle_roll_sim.model.tire.coefficients import NEUTRAL
from vehicle_roll_sim.vehicle.tire.idle_keys import FOREIGN, IDLE
from vehicle_roll_sim.vehicle.tire.keys import (
    ALL,
    COEFFICIENTS,
    KEYS,
    MATTERING,
    NUMERIC,
    RANGES,
    REQUIRED,
    SIMULATED,
)

TEXTS = ("PROPERTY_FILE_FORMAT", "FITTYP", "TYRESIDE", "USE_MODE", "FE_METHOD", "SIGN_CONVENTION")
MISSPELT = {
    "LMUYY = 0.5": "LMUY",
    "LMYU = 0.5": "LMY",
    "PKY1X = -3": "PKY1",
    "PKYI = -3": "PKY",
    "FZMINN = 3": "FZMIN",
    "UNLOADED_RADUIS = 0.3": "UNLOADED_RADIUS",
}


@pytest.mark.parametrize("line", MISSPELT)
def test_a_misspelt_key_is_refused_with_the_nearest_name(read, line):
    key = line.split()[0]
    text = BASE + line + "\n"
    with refused(line_of(text, key), key, f"did you mean {MISSPELT[line]}"):
        read(text)


@pytest.mark.parametrize(
    ("section", "line"),
    [
        ("MODEL", "TIRESIDE = 'RIGHT'"),
        ("MODEL", "FITTYPE = 61"),
        ("MODEL", "USEMODE = 3"),
        ("MODEL", "FE_METHODE = 'YES'"),
        ("UNITS", "LENGHT = 'mm'"),
        ("MAKER", "PKY11 = 3"),
        ("MAKER", "LMUYY = 0.5"),
        ("MAKER", "PQX9 = 1"),
    ],
)
def test_a_misspelt_key_of_any_section_is_refused(read, section, line):
    text = BASE + f"[{section}]\n{line}\n"
    with refused(line_of(text, line.split()[0]), line.split()[0], "unknown"):
        read(text)


@pytest.mark.parametrize("section", ["SCALING_COEFFICIENTS", "LATERAL_COEFFICIENTS", "VERTICAL"])
def test_an_unknown_key_among_coefficients_is_refused(read, section):
    text = BASE.replace(f"[{section}]\n", f"[{section}]\nZZZ = 1\n")
    with refused(line_of(text, "ZZZ"), "ZZZ is unknown"):
        read(text)


def test_keys_that_are_no_coefficients_pass_and_are_noted(read, base):
    maker = "[MAKER]\nCONSTRUCTION = 'A1'\nINFLATION_PRESSURE = 2.4\nDATESTAMP = '1 May'\n"
    tire = read(BASE + maker)
    assert tire == base
    assert any("[MAKER] CONSTRUCTION, [MAKER] INFLATION_PRESSURE" in note for note in tire.notes)


@pytest.mark.parametrize("key", [key for key in IDLE if key not in FOREIGN])
def test_a_key_without_effect_passes_with_any_value(read, base, key):
    line = f"{key} = 12.5" if key != "IP" else "IP = 200000"
    assert read(f"{BASE}[OTHER]\n{line}\n") == base


@pytest.mark.parametrize("version", ALL)
def test_every_coefficient_reaches_the_tire(read, version):
    """Each with a value of its own, beside all others as they are."""
    start = BASE if version == "5.2" else changed({"FITTYP": f"FITTYP = {version}"}, BASE_6_1)
    given = read(start).coefficients
    free = [
        name
        for name in COEFFICIENTS[version]
        if name not in (*REQUIRED, *RANGES) and f"\n{name} =" not in start
    ]
    values = {name: 1.0 + i / 8192 for i, name in enumerate(free)}
    values |= {name: values[name] / 8 for name in free if name.startswith("RH")}  # rad
    for name, value in values.items():
        tire = read(f"{start}[MORE]\n{name} = {value!r}\n")
        assert tire.coefficients == given | {name: value}


def test_the_equations_take_every_coefficient_that_is_read():
    """But the pressures, which are read to find their deviation, and ranges that are reported."""
    others = {"INFLPRES", "NOMPRES", "PRESMIN", "PRESMAX"}
    assert set(SIMULATED) - others == set(OF_EQUATIONS)
    for name in set(OF_EQUATIONS) - {"LONGVL"}:
        assert KEYS[name].default == NEUTRAL[name], name
    for version in ALL:
        assert set(REQUIRED) <= set(COEFFICIENTS[version])


def test_the_tables_of_keys_agree_with_each_other():
    for name, key in KEYS.items():
        assert key.meaning, name
        assert set(key.acts) | set(key.idle) <= set(ALL)
        assert not set(key.acts) & set(key.idle), name
    assert {*SIMULATED, *FOREIGN} == set(NUMERIC)
    assert {*NUMERIC, *TEXTS} == set(MATTERING)


@pytest.mark.parametrize(
    ("name", "value", "version"),
    [("PKY4", 1.5, "5.2"), ("PHY3", 0.1, "6.1"), ("Q_CAM1", 1.0, "6.1"), ("LGAX", 0.0, "6.2")],
)
def test_a_tire_made_by_hand_has_no_coefficient_of_another_version_either(
    base, name, value, version
):
    values = {name: base.coefficients[name] for name in REQUIRED}
    with refused(name, repr(value), version):
        Tire(values | {name: value}, version=version)
    with refused("PKY0"):
        Tire({"PKY0": 1.0})
    with refused("version", "'7'", "5.2 or 6.1 or 6.2"):
        Tire(values, version="7")
