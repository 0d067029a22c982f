"""Subset simulation against limit states whose probability is known."""

import numpy as np
import pytest
from scipy import stats

from vehicle_roll_sim.studies.subset_simulation import subset_simulation

RARE = 1e-4
REPEATS = 100


def linear(dimension: int):
    """The margin of a plane at the distance at which its probability is RARE."""
    distance = stats.norm.isf(RARE)
    return lambda points: points.sum(axis=1) / np.sqrt(dimension) - distance


@pytest.fixture(scope="module", params=[2, 6])
def estimates(request):
    return [subset_simulation(linear(request.param), request.param, s) for s in range(REPEATS)]


def test_one_in_ten_thousand_is_found_without_bias_and_within_the_stated_error(estimates):
    found = np.array([each.probability for each in estimates])
    stated = np.mean([each.variation for each in estimates])
    # the mean of 100 estimates with a coefficient of variation of 0.3: three standard errors
    assert found.mean() == pytest.approx(RARE, rel=3 * 0.3 / np.sqrt(REPEATS))
    # a deviation from 100 estimates is known to 7 %, and the stated one is rather wide
    assert np.log(found).std() == pytest.approx(stated, rel=0.25)
    within = np.mean([low <= RARE <= high for low, high in (e.interval for e in estimates)])
    assert within >= 0.86  # three standard errors below 0.95


def test_it_takes_a_tenth_of_the_runs_of_brute_force_or_less(estimates):
    found = np.array([each.probability for each in estimates])
    brute_force = (1.0 - RARE) / (RARE * (found.std() / RARE) ** 2)  # for the same deviation
    assert max(each.runs for each in estimates) < brute_force / 10
    stated = np.median([each.brute_force_runs for each in estimates])
    assert stated == pytest.approx(brute_force, rel=0.7)


def test_a_frequent_event_takes_one_level_like_brute_force():
    found = subset_simulation(lambda points: points[:, 0], 1, 1)
    assert (found.runs, found.levels) == (1000, (0.0,))
    assert found.probability == pytest.approx(0.5, abs=0.05)


def test_an_event_that_never_happens_has_an_upper_bound():
    found = subset_simulation(lambda points: -1.0 - points[:, 0] ** 2, 1, 1, most_levels=3)
    assert not found.is_reached
    assert found.probability < 2e-3


def test_unknown_margins_count_as_far_from_the_event():
    def margin(points):
        return np.where(points[:, 1] < 0.0, np.nan, points[:, 0] - stats.norm.isf(0.01))

    found = subset_simulation(margin, 2, 1)
    assert found.unknown > 400
    assert found.probability == pytest.approx(0.005, rel=0.5)
