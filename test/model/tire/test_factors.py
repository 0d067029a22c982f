"""What is computed once for a tire, of its coefficients and its pressure."""

from pathlib import Path

import numpy as np
import pytest

from vehicle_roll_sim import load_tire
from vehicle_roll_sim.model.tire.coefficients import COEFFICIENTS, NEUTRAL
from vehicle_roll_sim.model.tire.factors import FACTORS, factors_of

EFFECTS_OF_PRESSURE = (
    *("longitudinal_grip", "lateral_grip", "slip_stiffening", "cornering_load_growth"),
    *("camber_stiffening", "trail_growth", "camber_moment_growth", "overturning_growth"),
)
DATA = Path(__file__).parent / "data"


def test_at_nominal_pressure_no_effect_of_pressure_changes_a_bit():
    every = dict.fromkeys(COEFFICIENTS, 0.7)
    found = factors_of(every, 0.0)
    assert {found[name] for name in EFFECTS_OF_PRESSURE} == {1.0}


def test_far_from_nominal_pressure_grip_and_stiffness_end_at_zero():
    falling = NEUTRAL | {"FNOMIN": 4000.0, "PKY1": -20.0, "PPX3": -1.0, "PPY3": -1.0, "PPX1": -1.0}
    found = factors_of(falling | {"PPY1": -1.0}, 2.0)
    ended = ("longitudinal_grip", "lateral_grip", "slip_stiffening", "largest_cornering_stiffness")
    assert [found[name] for name in ended] == [0.0, 0.0, 0.0, 0.0]


@pytest.mark.parametrize("name", ["mf61.tir", "mf62.tir"])
def test_the_record_of_a_tire_holds_the_factors_of_its_pressure(name):
    tire = load_tire(DATA / name)
    nominal, other = tire.coefficients["NOMPRES"], 1.25 * tire.coefficients["NOMPRES"]
    for pressure in (nominal, other):
        record = tire.record(pressure)[0]
        given = {key: float(record[key]) for key in COEFFICIENTS}
        expected = factors_of(given, (pressure - nominal) / nominal)
        np.testing.assert_array_equal([record[key] for key in FACTORS], [*expected.values()])
    carcass = tire.coefficients["LATERAL_STIFFNESS"] * (1 + tire.coefficients["PCFY3"] / 4)
    assert record["lateral_carcass_stiffness"] == pytest.approx(carcass, rel=1e-15)
