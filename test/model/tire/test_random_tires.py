"""Random tires near those of the data: reader and kernels together give what the oracle gives."""

import magic_formula
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tire_files import (
    NAMES,
    TOLERANCE,
    changed,
    numbers_of,
    of_the_oracle,
    of_the_package,
    points_for,
    text_of,
    worst,
)

SPREAD = 0.15
"""Coefficients are taken from this range about those of the data, relative to them.

With a larger one, a slip stiffness would be negative at the lowest loads.
"""
SHAPES = ("PCX1", "PCY1", "RCX1", "RCY1", "QCZ1")
"""With these too large, the tire would push; they are only made smaller."""
LIMITS = ("MIN", "MAX")
SEEDS = st.integers(0, 2**32 - 1)


def random_text(name: str, seed: int) -> str:
    """A file of which every number that the oracle uses is another one."""
    rng = np.random.default_rng(seed)
    values = {}
    for key, number in numbers_of(name).items():
        if key.endswith(LIMITS) or number == 0.0:
            continue
        factor = rng.uniform(1 - SPREAD, 1.0 if key in SHAPES else 1 + SPREAD)
        values[key] = repr(number * factor)
    return changed(text_of(name), values)


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=15)
@given(seed=SEEDS)
def test_a_random_tire_gives_what_the_oracle_gives(name, seed, tmp_path_factory):
    path = tmp_path_factory.mktemp("tire") / "random.tir"
    path.write_text(random_text(name, seed), encoding="utf-8")
    p, _ = magic_formula.read(path)
    points = points_for(p, seed)
    differences = worst(of_the_package(path, points), of_the_oracle(path, points))
    assert max(differences.values()) < TOLERANCE, differences


@pytest.mark.parametrize("side", ["Left", "Right"])
@pytest.mark.parametrize("name", NAMES)
def test_a_file_made_for_either_side_is_mirrored_on_the_other(name, side, tmp_path):
    path = tmp_path / "side.tir"
    path.write_text(changed(text_of(name), {"TYRESIDE": f"'{side}'"}), encoding="utf-8")
    points = points_for(magic_formula.read(path)[0], 11)
    differences = worst(of_the_package(path, points), of_the_oracle(path, points))
    assert max(differences.values()) < TOLERANCE, differences
