"""Units of columns against factors from their definitions."""

import math
import sys

import pytest

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs import units

pytest.importorskip("pint", reason="the units of the log need pint")
FACTORS = [
    ("km/h", "m/s", 1 / 3.6),
    ("mph", "m/s", 0.44704),
    ("deg/s", "rad/s", math.pi / 180),
    ("°/s", "rad/s", math.pi / 180),
    ("rpm", "rad/s", math.pi / 30),
    ("1/s", "rad/s", 1.0),
    ("g", "m/s^2", 9.80665),
    ("m/s²", "m/s^2", 1.0),
    ("mm/s^2", "m/s^2", 1e-3),
    ("Nm", "N m", 1.0),
    ("kN", "N", 1e3),
    ("kgf", "N", 9.80665),
    ("ms", "s", 1e-3),
    ("ns", "s", 1e-9),
]


@pytest.mark.parametrize(("unit", "wanted", "expected"), FACTORS)
def test_factors_are_those_of_the_definitions(unit, wanted, expected):
    assert units.factor(unit, wanted, "x") == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    "unit", ["m", "bogus", "deg/", "9^9^9^9", "m**9", "", "s" * 40, "import(os)"]
)
def test_what_is_no_such_unit_is_refused_in_one_line(unit):
    with pytest.raises(InputError) as raised:
        units.factor(unit, "rad/s", "map: yaw_rate: unit")
    assert str(raised.value).startswith("map: yaw_rate: unit: ")
    assert str(raised.value).endswith("a unit that converts to rad/s")


def test_si_units_need_no_library_and_others_name_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "pint", None)
    units._pint.cache_clear()
    try:
        assert units.factor("rad/s", "rad/s", "x") == 1.0
        with pytest.raises(InputError, match=r"no Python package pint: pip install 'vehicle_roll"):
            units.factor("deg/s", "rad/s", "x")
    finally:
        units._pint.cache_clear()
