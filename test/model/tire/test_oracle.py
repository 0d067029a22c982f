"""The oracle itself: against values of tires that other implementations of the formula confirm.

The tables give slips, load, inclination, pressure, speed and side of a wheel, and forces, moments
and radii there. Their weights of combined slip are those published, which may be negative.
"""

import csv
from pathlib import Path

import magic_formula
import numpy as np
import pytest

DATA = Path(__file__).parent / "data"
TOLERANCE = 1e-14
"""Relative to the largest value of a column: rounding, of the tables as of the oracle."""
COLUMNS = ("Fx", "Fy", "Mx", "My", "Mz", "Rl", "Re")
"""Of the tables, in the order of the oracle's values."""


def table(name):
    """The columns of a table by name; nan where it leaves a field empty. side: text."""
    with (DATA / f"{name}_values.csv").open() as file:
        rows = list(csv.DictReader(file))
    columns = {key: [row[key] for row in rows] for key in rows[0]}
    side = np.array(columns.pop("side"))
    columns.pop("limited")  # which curvature factors were cut to 1
    return {k: np.array([float(v or "nan") for v in column]) for k, column in columns.items()}, side


def evaluated(p, at, side):
    """The oracle at every row."""
    pressure = None if p.version == "5.2" else at["pressure"]
    slips = at["kappa"], at["alpha"], at["gamma"]
    return magic_formula.evaluate(p, at["Fz"], *slips, pressure, at["vx"], side == "right")


@pytest.mark.parametrize("name", ["mf52_full", "mf61", "mf62"])
def test_every_value_of_the_tables_is_met(name):
    p, made_for = magic_formula.read(DATA / f"{name}.tir")
    at, side = table(name)
    assert made_for == "left"
    for column, values in zip(COLUMNS, evaluated(p.as_published(), at, side), strict=True):
        given = ~np.isnan(at[column])
        assert given.sum() >= 50 or (name, column) == ("mf52_full", "Rl")  # which 5.2 has not
        off = np.abs(values - at[column])[given]
        assert (off <= TOLERANCE * np.abs(at[column])[given].max(initial=0.0)).all(), column


@pytest.mark.parametrize(("name", "negative"), [("mf52_full", 2), ("mf61", 2), ("mf62", 0)])
def test_weights_that_end_at_zero_change_only_rows_where_they_were_negative(name, negative):
    p, _ = magic_formula.read(DATA / f"{name}.tir")
    at, side = table(name)
    hand = np.where(side == "right", -1.0, 1.0)
    where = at["kappa"], hand * at["alpha"], at["Fz"], hand * at["gamma"]
    weights = [
        function(p.as_published(), *where)
        for function in (magic_formula.longitudinal_weight, magic_formula.lateral_weight)
    ]
    reversed_rows = np.minimum(*weights) < 0
    assert reversed_rows.sum() == negative
    ended, published = evaluated(p, at, side), evaluated(p.as_published(), at, side)
    for mine, theirs in zip(ended, published, strict=True):
        assert np.array_equal(mine[~reversed_rows], theirs[~reversed_rows], equal_nan=True)
    assert (ended.lateral_force != published.lateral_force)[reversed_rows].all()


def test_a_loaded_radius_carries_its_load():
    for name in ("mf61", "mf62"):
        p, _ = magic_formula.read(DATA / f"{name}.tir")
        load = np.linspace(200.0, 12_000.0, 60)  # N
        at = {"camber": 0.05, "dp": 0.1, "spin": np.full(60, 80.0)}
        forces = {"fx": -0.3 * load, "fy": 0.4 * load}
        radius = magic_formula.loaded_radius(p, load, **forces, **at)
        assert (np.diff(radius) < 0).all()
        assert magic_formula.load_at(p, radius, **forces, **at) == pytest.approx(load, rel=1e-9)
