"""What is kept of a long run."""

import itertools

import numpy as np
import pytest
from viewed_runs import of_columns

from vehicle_roll_sim.viewer.decimation import kept_rows

COUNT, MOST = 200_000, 4000
PEAK, DIP, LIFTED = 123_457, 150_001, slice(77_001, 77_004)


@pytest.fixture
def history():
    """More than half an hour: noise, one peak, one dip, and one wheel that lifts for 30 ms."""
    noise = np.random.default_rng(1).normal(size=COUNT)
    noise[PEAK], noise[DIP] = 100.0, -100.0
    loads = np.full(COUNT, 4000.0)
    loads[LIFTED] = 0.0
    wheels = {f"normal_force_{wheel}": 4000.0 for wheel in ("rf", "lr", "rr")}
    return of_columns(COUNT, roll=noise, normal_force_lf=loads, **wheels)


def kept(history, *times: float) -> np.ndarray:
    return kept_rows(history, [history["roll"], history["normal_force_lf"]], times, MOST)


def test_a_short_run_is_kept_as_it_is():
    np.testing.assert_array_equal(kept_rows(of_columns(MOST), [], [], MOST), np.arange(MOST))


def test_a_long_run_is_thinned_to_about_that_many_rows_in_order(history):
    rows = kept(history)
    assert 0.5 * MOST < len(rows) <= MOST + 8
    assert (np.diff(rows) > 0).all()
    assert (rows[0], rows[-1]) == (0, COUNT - 1)
    assert np.diff(rows).max() <= COUNT // (MOST // 2) + 1


def test_every_peak_is_kept(history):
    assert {PEAK, DIP} <= {*kept(history).tolist()}


def test_in_every_interval_the_largest_and_the_smallest_value_are_kept(history):
    rows, roll = kept(history), history["roll"]
    edges = np.linspace(0, COUNT, MOST // 8 + 1).round().astype(int)
    for begin, end in itertools.pairwise(edges):
        inside = roll[rows[(begin <= rows) & (rows < end)]]
        assert inside.max() == roll[begin:end].max()
        assert inside.min() == roll[begin:end].min()


def test_both_sides_of_a_lift_off_and_of_a_touch_down_are_kept(history):
    around = {LIFTED.start - 1, LIFTED.start, LIFTED.stop - 1, LIFTED.stop}
    assert around <= {*kept(history).tolist()}


def test_the_rows_around_an_event_are_kept(history):
    assert {99_990, 99_991} <= {*kept(history, 999.905, np.nan).tolist()}


def test_values_that_are_not_known_are_no_peaks():
    roll = np.full(COUNT, np.nan)
    roll[PEAK] = 1.0
    assert PEAK in kept_rows(of_columns(COUNT), [roll], [], MOST)
