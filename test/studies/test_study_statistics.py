"""Probabilities, quantiles and Sobol indices against closed forms and brute force."""

import math

import numpy as np
import pytest
from scipy import stats
from scipy.stats import qmc

from vehicle_roll_sim.studies.designs import saltelli
from vehicle_roll_sim.studies.statistics import probability, quantiles, sobol_indices


@pytest.mark.parametrize(("events", "runs"), [(0, 10), (3, 100), (50, 60), (60, 60)])
def test_the_interval_of_a_probability_is_that_of_wilson(events, runs):
    z, p = 1.959964, events / runs
    centre = (p + z**2 / (2 * runs)) / (1 + z**2 / runs)
    half = z / (1 + z**2 / runs) * math.sqrt(p * (1 - p) / runs + z**2 / (4 * runs**2))
    found = probability(events, runs)
    assert found == pytest.approx((p, centre - half, centre + half), abs=1e-6)


def test_intervals_contain_the_probability_of_a_known_limit_state_as_often_as_they_say():
    """x + y >= 2 of two standard normal variables: probability 1 - Phi(sqrt 2) = 0.0786."""
    exact = stats.norm.sf(math.sqrt(2.0))
    draws = np.random.default_rng(1).standard_normal((400, 200, 2)).sum(axis=2) >= 2.0
    found = [probability(int(each.sum()), len(each)) for each in draws]
    share = np.mean([each.low <= exact <= each.high for each in found])
    assert share == pytest.approx(0.95, abs=0.035)  # 3 standard errors of 400 trials


def test_the_interval_of_a_quantile_contains_it_and_narrows_with_the_runs():
    values = np.random.default_rng(2).standard_normal(4000)
    few, many = (quantiles(values[:n], [0.1, 0.9])[1] for n in (400, 4000))
    for each in (few, many):
        assert each.low <= stats.norm.ppf(0.9) <= each.high
    # of a quantile: sqrt(p (1 - p) / n) / density
    deviation = math.sqrt(0.09 / 4000) / stats.norm.pdf(stats.norm.ppf(0.9))
    assert many.high - many.low == pytest.approx(3.92 * deviation, rel=0.3)
    assert few.high - few.low > 2.0 * (many.high - many.low)


def test_sobol_indices_of_the_function_of_ishigami_are_those_of_the_closed_form():
    shares = saltelli(qmc.Sobol(6, seed=np.random.default_rng(1)).random(1024))
    x, y, z = (2.0 * shares.T - 1.0) * math.pi
    values = np.sin(x) + 7.0 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x)
    found = sobol_indices(values, 3)
    assert [each.first.value for each in found] == pytest.approx([0.3139, 0.4424, 0.0], abs=0.02)
    assert [each.total.value for each in found] == pytest.approx([0.5576, 0.4424, 0.2437], abs=0.02)
    for each in (*found[0], *found[1]):
        assert each.low < each.value < each.high
