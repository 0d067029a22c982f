"""Tires without a vehicle: forces, moments and radii against tables and the oracle, and limits."""

import json
import os
import subprocess
import sys
from pathlib import Path

import magic_formula
import numpy as np
import pytest
from patience import PATIENCE

from vehicle_roll_sim import InputError, load_tire
from vehicle_roll_sim.vehicle.tire import moments
from vehicle_roll_sim.vehicle.tire_evaluation import TireForces, evaluate

DATA = Path(__file__).parents[2] / "model" / "tire" / "data"
FILES = ("mf52_full", "mf61", "mf62")
COLUMNS = ("Fx", "Fy", "Mx", "My", "Mz", "Rl", "Re")
"""Of the tables, in the order of TireForces."""
ROUNDING = 1e-13
"""Relative to the largest value of a column."""
CASES = 200
FACTORS_OF_MX = tuple(f"QSX{number}" for number in range(4, 12))
"""They act together only."""
REVERSED = {"mf52_full": 2, "mf61": 2, "mf62": 0}
"""Rows of the tables with a weight of combined slip below 0."""


def tire_of(name):
    return load_tire(DATA / f"{name}.tir")


def table_of(name) -> np.ndarray:
    return np.genfromtxt(
        DATA / f"{name}_values.csv", delimiter=",", names=True, dtype=None, encoding="utf-8"
    )


def evaluated(name, **how) -> TireForces:
    """The tire at every row of its table."""
    tire, rows = tire_of(name), table_of(name)
    points = [
        evaluate(
            tire,
            *(row["Fz"], row["kappa"], row["alpha"], row["gamma"]),
            None if tire.version == "5.2" else row["pressure"],
            row["vx"],
            row["side"],
            **how,
        )
        for row in rows
    ]
    return TireForces(*np.array(points, float).T)


@pytest.mark.parametrize("name", FILES)
def test_every_value_of_the_tables_is_met_on_both_sides(name):
    rows = table_of(name)
    assert set(rows["side"]) == {"left", "right"}
    for column, values in zip(COLUMNS, evaluated(name, as_published=True), strict=True):
        if (name, column) == ("mf52_full", "Rl"):  # which 5.2 does not have
            assert np.isnan(values).all()
            continue
        known = ~np.isnan(rows[column])
        largest = np.abs(rows[column][known]).max()
        assert np.abs(values - rows[column])[known].max() <= ROUNDING * largest, column


@pytest.mark.parametrize("name", FILES)
def test_a_weight_that_would_reverse_a_force_ends_at_zero(name):
    simulated, published = evaluated(name), evaluated(name, as_published=True)
    differs = simulated.lateral_force != published.lateral_force
    assert differs.sum() == REVERSED[name]
    np.testing.assert_array_equal(simulated.longitudinal_force, published.longitudinal_force)


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("side", ["left", "right"])
def test_it_is_the_oracle_anywhere(name, side):
    tire, rng = tire_of(name), np.random.default_rng(3)
    p, _ = magic_formula.read(DATA / f"{name}.tir")
    load, kappa = rng.uniform(300.0, 11_000.0, CASES), rng.uniform(-0.9, 1.5, CASES)
    alpha, gamma = rng.uniform(-1.5, 1.5, CASES), rng.uniform(-0.3, 0.3, CASES)
    pressure = None if tire.version == "5.2" else 0.9 * tire.coefficients["NOMPRES"]
    mine = evaluate(tire, load, kappa, alpha, gamma, pressure, 20.0, side)
    theirs = magic_formula.evaluate(p, load, kappa, alpha, gamma, pressure, 20.0, side == "right")
    for name, one, other in zip(TireForces._fields[:5], mine, theirs, strict=False):
        assert np.abs(one - other).max() <= 1e-11 * np.abs(other).max(), name
    known = ~np.isnan(theirs.loaded_radius)
    np.testing.assert_allclose(mine[5][known], theirs.loaded_radius[known], rtol=1e-9)
    np.testing.assert_allclose(mine[6], theirs.effective_rolling_radius, rtol=1e-12)


@pytest.mark.parametrize("name", FILES)
def test_left_and_right_wheel_are_mirror_images(name):
    tire, rng = tire_of(name), np.random.default_rng(4)
    load, kappa = rng.uniform(300.0, 11_000.0, CASES), rng.uniform(-1.5, 1.5, CASES)
    alpha, gamma = rng.uniform(-1.5, 1.5, CASES), rng.uniform(-0.3, 0.3, CASES)
    left = evaluate(tire, load, kappa, alpha, gamma)
    right = evaluate(tire, load, kappa, -alpha, -gamma, side="right")
    for field in TireForces._fields:
        turns = field in ("lateral_force", "overturning_moment", "aligning_moment")
        sign = -1.0 if turns else 1.0
        np.testing.assert_array_equal(getattr(left, field), sign * getattr(right, field))


@pytest.mark.parametrize("name", FILES)
def test_nothing_without_load(name):
    for load in (0.0, -1.0, -1e4):
        off_the_ground = evaluate(tire_of(name), load, 0.3, -0.2, 0.1)
        assert off_the_ground[:5] == (0.0,) * 5
        if name != "mf52_full":
            almost = evaluate(tire_of(name), 1e-6, 0.3, -0.2)
            assert off_the_ground.loaded_radius == pytest.approx(almost.loaded_radius, abs=1e-9)


@pytest.mark.parametrize("name", FILES)
def test_forces_are_finite_at_rest_in_reverse_and_far_out_of_range(name):
    tire, huge = tire_of(name), 1e3
    slips = np.array([0.0, 1e-12, 0.1, -1.0, 1.0, huge, -huge])
    angles = np.array([0.0, 1e-12, 0.2, -1.0, 1.5, np.pi / 2])
    load = np.array([1e-9, 100.0, 4000.0, 1e6])
    grid = np.meshgrid(load, slips, angles, [-1.5, -0.1, 0.0, 0.5], [-30.0, -0.5, 0.0, 0.5, 90.0])
    *where, speed = (each.ravel() for each in grid)
    found = evaluate(tire, *where, speed=speed)
    for field in TireForces._fields[:5]:
        assert np.isfinite(getattr(found, field)).all(), field


@pytest.mark.parametrize("name", FILES)
def test_in_reverse_trail_and_rolling_resistance_turn_round(name):
    tire = tire_of(name)
    ahead, back = (evaluate(tire, 4000.0, 0.0, 0.05, speed=v) for v in (20.0, -20.0))
    assert ahead.rolling_resistance_moment < 0.0 < back.rolling_resistance_moment
    assert ahead.aligning_moment == pytest.approx(-back.aligning_moment, rel=0.3)  # but for shifts
    assert ahead.lateral_force == back.lateral_force


def test_a_tire_that_does_not_depend_on_pressure_refuses_one():
    with pytest.raises(InputError, match="pressure"):
        evaluate(tire_of("mf52_full"), 4000.0, 0.0, 0.1, pressure=2e5)
    with pytest.raises(InputError, match="side"):
        evaluate(tire_of("mf61"), 4000.0, 0.0, 0.1, side="middle")


def test_plain_python_gives_the_same():
    text = (
        "import sys, numpy as np\n"
        "from vehicle_roll_sim import load_tire\n"
        "from vehicle_roll_sim.vehicle.tire_evaluation import evaluate\n"
        "slip = np.linspace(-1.0, 1.0, 12)\n"
        "found = evaluate(load_tire(sys.argv[1]), 4000.0, slip, 0.3 * slip, 0.1)\n"
        "print(np.array(found).tolist())\n"
    )
    found = []
    for off in ("0", "1"):
        words = [sys.executable, "-c", text, str(DATA / "mf62.tir")]
        done = subprocess.run(
            words,
            capture_output=True,
            text=True,
            check=True,
            timeout=PATIENCE,
            env={**os.environ, "NUMBA_DISABLE_JIT": off},
        )
        found.append(np.array(json.loads(done.stdout)))
    np.testing.assert_allclose(*found, rtol=1e-12)


@pytest.mark.parametrize("name", FILES)
def test_moments_are_computed_only_for_a_tire_that_has_one(name):
    """The other coefficients of moments, such as shape factors, give none by themselves."""
    tire = tire_of(name)
    names = [n for acting in moments.COEFFICIENTS.values() for n in acting]
    names = [n for n in names if tire.coefficients[n]]
    bare = tire.with_coefficients(**dict.fromkeys(names, 0.0))
    assert tire.record(moments=True)["moments"] == 1.0
    assert bare.record(moments=True)["moments"] == 0.0
    for own in ([], *([n] for n in names if n not in FACTORS_OF_MX)):
        given = bare.with_coefficients(**{n: tire.coefficients[n] for n in own})
        assert given.record(moments=True)["moments"] == bool(own), own
        p = magic_formula.Coefficients(given.coefficients, tire.version)
        rows = magic_formula.evaluate(p, 6000.0, 0.05, [0.05, -0.1], 0.06, speed=20.0)
        assert any(np.any(rows[k]) for k in range(2, 5)) == bool(own), own
