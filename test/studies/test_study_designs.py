"""Designs against what defines them: the values, their distributions and their correlation."""

import math

import numpy as np
import pytest
from scipy import stats

from vehicle_roll_sim.studies.designs import draws_of, points_of
from vehicle_roll_sim.studies.factors import LogNormal, Normal, Triangular, Uniform

HEIGHT, MASS = "vehicle.cg_height", "vehicle.sprung_mass"
DRAWN = {
    HEIGHT: {"distribution": "normal", "mean": 0.7, "sd": 0.05},
    MASS: {"distribution": "uniform", "lowest": 1000.0, "highest": 2000.0},
}


def test_a_grid_has_all_combinations_and_no_others(study):
    points = [tuple(point.values()) for point in points_of(study())]
    assert points == [(h, v) for h in (0.5, 0.6, 0.7, 0.8) for v in (10.0, 20.0, 30.0)]


def test_every_grid_point_has_the_same_draws(study):
    factors = {"manoeuvre.speed": [10.0, 20.0], **DRAWN}
    points = points_of(study(factors=factors, design="random", runs=3, seed=1))
    assert len(points) == 6
    slow, fast = points[:3], points[3:]
    assert [{**each, "manoeuvre.speed": 20.0} for each in slow] == fast


@pytest.mark.parametrize("design", ["latin_hypercube", "sobol", "random", "saltelli"])
def test_the_same_seed_gives_the_same_draws_and_another_others(study, design):
    first, again, other = (
        list(points_of(study(factors=DRAWN, design=design, runs=8, seed=seed)))
        for seed in (1, 1, 2)
    )
    assert first == again != other


def test_a_latin_hypercube_has_one_draw_in_each_of_equally_likely_parts(study):
    draws = draws_of(study(factors=DRAWN, design="latin_hypercube", runs=50, seed=1))
    shares = stats.norm.cdf(draws[HEIGHT], 0.7, 0.05)
    assert sorted(np.floor(50 * shares)) == list(range(50))


def test_correlated_factors_keep_their_distributions_and_have_the_correlation(study):
    given = {"correlations": [[HEIGHT, MASS, 0.6]], "design": "sobol", "runs": 4096, "seed": 1}
    draws = draws_of(study(factors=DRAWN, **given))
    height, mass = draws[HEIGHT], draws[MASS]
    assert stats.kstest(height, stats.norm(0.7, 0.05).cdf).statistic < 0.01
    assert stats.kstest(mass, stats.uniform(1000.0, 1000.0).cdf).statistic < 0.01
    # of normal scores with correlation r, the rank correlation is 6/pi asin(r/2)
    expected = 6.0 / math.pi * math.asin(0.3)
    assert stats.spearmanr(height, mass).statistic == pytest.approx(expected, abs=0.01)


@pytest.mark.parametrize(
    ("distribution", "expected"),
    [
        (Uniform(2.0, 4.0), [2.5, 3.5]),
        (Normal(10.0, 2.0), [10.0 - 2.0 * 0.6744898, 10.0 + 2.0 * 0.6744898]),
        (Normal(0.0, 1.0, lowest=0.0), [stats.norm.ppf(0.625), stats.norm.ppf(0.875)]),
        (Triangular(0.0, 1.0, 2.0), [math.sqrt(0.5), 2.0 - math.sqrt(0.5)]),
    ],
)
def test_quartiles_are_those_of_the_closed_form(distribution, expected):
    assert distribution.at(np.array([0.25, 0.75])) == pytest.approx(expected)


def test_a_lognormal_has_the_mean_and_deviation_that_are_given():
    values = LogNormal(1500.0, 300.0).at((np.arange(100_000) + 0.5) / 100_000)
    assert (values.mean(), values.std()) == pytest.approx((1500.0, 300.0), rel=2e-3)
