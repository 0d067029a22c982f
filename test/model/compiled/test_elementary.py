"""The elementary functions of the kernels against those of the platform in extended precision."""

import math

import numpy as np
import pytest
from entries import entry

from vehicle_roll_sim.model.compiled import elementary

arctan, sine, cosine = map(entry, (elementary.arctan, elementary.sine, elementary.cosine))
cosine_of_arctan = entry(elementary.cosine_of_arctan)
sine_of_twice_arctan = entry(elementary.sine_of_twice_arctan)
exponential, logarithm = entry(elementary.exponential), entry(elementary.logarithm)
arctan_of_ratio = entry(elementary.arctan_of_ratio)
arctan_of_hypotenuse = entry(elementary.arctan_of_hypotenuse)
CASES = 20_000
UNITS = 2.5
"""Units in the last place of the result: a handful of rounded operations."""
EVERY_SIZE = np.geomspace(1e-300, 1e300, CASES)
ALL = np.concatenate([-EVERY_SIZE, EVERY_SIZE, np.linspace(-10.0, 10.0, CASES)])
TURNS = np.linspace(-1000.0, 1000.0, CASES)
pytestmark = pytest.mark.skipif(
    np.finfo(np.longdouble).nmant <= np.finfo(float).nmant, reason="no extended precision here"
)


def errors(function, exact, arguments):
    """In units in the last place of the exact value."""
    expected = exact(arguments.astype(np.longdouble))
    mine = np.array([function(float(x)) for x in arguments])
    return np.abs(mine - expected) / np.spacing(np.abs(expected.astype(float)))


def test_the_arc_tangent_is_right_over_all_numbers():
    assert errors(arctan, np.arctan, ALL).max() < UNITS


@pytest.mark.parametrize(("mine", "exact"), [(sine, np.sin), (cosine, np.cos)])
def test_sine_and_cosine_are_right_over_many_turns(mine, exact):
    assert errors(mine, exact, np.linspace(-4.0, 4.0, CASES)).max() < UNITS
    assert errors(mine, exact, TURNS).max() < UNITS


@pytest.mark.parametrize(("mine", "exact"), [(sine, np.sin), (cosine, np.cos)])
def test_beyond_a_million_radians_they_are_as_exact_as_their_argument(mine, exact):
    angles = np.geomspace(1e6, 1e12, 1000)
    expected = exact(angles.astype(np.longdouble))
    error = np.abs(np.array([mine(float(x)) for x in angles]) - expected)
    assert (error <= np.spacing(angles)).all()


def test_exponential_and_logarithm_are_right_over_all_sizes():
    assert errors(exponential, np.exp, np.linspace(-700.0, 700.0, CASES)).max() < UNITS
    assert errors(exponential, np.exp, np.linspace(-2.0, 2.0, CASES)).max() < UNITS
    assert errors(logarithm, np.log, EVERY_SIZE).max() < UNITS
    assert errors(logarithm, np.log, np.linspace(0.01, 4.0, CASES)).max() < UNITS
    assert (exponential(0.0), logarithm(1.0)) == (1.0, 0.0)
    assert exponential(1e4) == exponential(700.0) == 1 / exponential(-1e4)


def test_the_arc_tangent_of_a_ratio_is_right_up_to_a_base_of_0():
    sizes, base = np.geomspace(1e-9, 1e9, CASES), 0.37
    for sign in (1.0, -1.0):

        def of_ratio(x, sign=sign):
            return arctan_of_ratio(sign * x, base)

        exact = errors(of_ratio, lambda x, sign=sign: np.arctan(sign * x / base), sizes)
        assert exact.max() < UNITS
    assert (arctan_of_ratio(2.0, 0.0), arctan_of_ratio(-2.0, 0.0)) == (math.pi / 2, -math.pi / 2)
    assert arctan_of_ratio(0.0, 2.0) == 0.0
    assert all(arctan_of_ratio(x, 1.0) == arctan(x) for x in ALL)


@pytest.mark.parametrize("y", [0.0, -0.3, 7.0, 1e200])
def test_the_arc_tangent_of_a_hypotenuse_is_right_in_every_quadrant(y):
    def exact(x):
        return np.arctan(np.hypot(np.tan(x), np.longdouble(y)))

    angles = np.linspace(-4.5, 4.5, CASES)
    assert errors(lambda x: arctan_of_hypotenuse(x, y), exact, angles).max() < 4


def test_the_compositions_are_those_of_the_functions():
    def of_twice(x):
        return np.sin(2 * np.arctan(x))

    some = np.concatenate([-np.geomspace(1e-9, 1e9, 999), np.geomspace(1e-9, 1e9, 999)])
    assert errors(cosine_of_arctan, lambda x: np.cos(np.arctan(x)), some[abs(some) < 1e3]).max() < 4
    assert errors(sine_of_twice_arctan, of_twice, some[abs(some) < 1e3]).max() < 4


@pytest.mark.parametrize("function", [arctan, sine])
def test_odd_functions_are_odd_to_the_bit(function):
    for x in TURNS:
        assert function(-x) == -function(x)
    assert function(0.0) == 0.0


def test_the_cosine_is_even_to_the_bit_and_1_at_0():
    for x in TURNS:
        assert cosine(-x) == cosine(x)
    assert cosine(0.0) == 1.0


def test_infinities_and_nan_go_through():
    assert arctan(math.inf) == math.pi / 2
    assert arctan(-math.inf) == -math.pi / 2
    assert math.isnan(arctan(math.nan))
    for function in (sine, cosine):
        assert math.isnan(function(math.inf))
        assert math.isnan(function(math.nan))
    assert cosine_of_arctan(math.inf) == 0.0
