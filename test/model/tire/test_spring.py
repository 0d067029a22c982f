"""The tire as a spring against the roots and the slope of its polynomial."""

import numpy as np
import pytest
from entries import entry

from vehicle_roll_sim.model.tire.spring import compression_under, spring_force

force_of = entry(spring_force)
COMPRESSIONS = np.linspace(0.0, 0.08, 41)
"""m"""
STIFFNESS = 2.1e5
"""N/m"""


@pytest.mark.parametrize("progression", [0.0, 0.5, 8.0, 1e4])
def test_force_and_compression_are_each_others_inverse(progression):
    for x in COMPRESSIONS:
        force = STIFFNESS * x + STIFFNESS * progression * x**2
        assert force_of(x, STIFFNESS, progression) == pytest.approx(force, rel=1e-15)
        assert compression_under(force, STIFFNESS, progression) == pytest.approx(x, rel=1e-13)


def test_a_linear_spring_is_linear_to_the_bit():
    for x in COMPRESSIONS:
        assert force_of(x, STIFFNESS, 0.0) == STIFFNESS * x
        assert compression_under(STIFFNESS * x, STIFFNESS, 0.0) == STIFFNESS * x / STIFFNESS


def test_off_the_ground_the_progression_has_no_part():
    assert force_of(-0.05, STIFFNESS, 8.0) == -0.05 * STIFFNESS
    near = 1e-9  # the slope does not jump at contact
    slopes = [force_of(x, STIFFNESS, 8.0) / x for x in (-near, near)]
    assert slopes == pytest.approx([STIFFNESS] * 2, rel=1e-7)
