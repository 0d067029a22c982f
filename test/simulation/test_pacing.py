"""Keeping step with a clock: every period once, late ones made up for, but never too many."""

import random

import pytest

from vehicle_roll_sim.simulation.pacing import Pacer

MS = 1_000_000
PERIOD = 10 * MS
CATCH_UP = 100 * MS
"""ns: at most so much is made up for."""


class FakeClock:
    """A clock that goes on when it is told to."""

    def __init__(self):
        self.now_ns = 123_456_789

    def __call__(self) -> int:
        return self.now_ns


class Paced:
    """A started pacer on a fake clock."""

    def __init__(self, period_ns: int = PERIOD):
        self.clock = FakeClock()
        self.pacer = Pacer(period_ns, self.clock)
        assert not self.pacer.due()  # the first period is over one period later

    def after(self, ns: int) -> int:
        """Periods that are run when another `ns` have passed: the due one, and those behind it."""
        self.clock.now_ns += ns
        count = int(self.pacer.due())
        while self.pacer.behind:
            assert self.pacer.due()
            count += 1
        return count


@pytest.fixture
def paced() -> Paced:
    return Paced()


def test_on_time_every_call_runs_one_period(paced):
    assert [paced.after(PERIOD) for _ in range(1000)] == [1] * 1000
    assert (paced.pacer.largest_late_ns, paced.pacer.overruns) == (0, 0)


def test_nothing_is_due_again_at_the_same_time(paced):
    assert [paced.after(PERIOD), paced.after(0), paced.after(0)] == [1, 0, 0]


def test_a_call_that_comes_a_little_late_does_not_move_the_next_deadline(paced):
    assert paced.after(PERIOD + 3 * MS) == 1
    assert paced.after(PERIOD - 3 * MS) == 1
    assert paced.pacer.largest_late_ns == 3 * MS


def test_periods_that_were_missed_are_made_up_for_one_by_one(paced):
    assert paced.after(4 * PERIOD + MS) == 4
    assert paced.pacer.largest_late_ns == 3 * PERIOD + MS
    assert paced.pacer.overruns == 0
    assert paced.after(PERIOD - MS) == 1


def test_a_wake_up_a_little_early_counts_for_its_period_and_not_twice(paced):
    assert [paced.after(PERIOD - 4 * MS), paced.after(4 * MS)] == [1, 0]
    assert paced.after(PERIOD) == 1
    assert paced.pacer.largest_late_ns == 0


def test_a_wake_up_far_too_early_runs_nothing(paced):
    assert [paced.after(4 * MS), paced.after(6 * MS)] == [0, 1]


@pytest.mark.parametrize("period", [MS, 5 * MS, PERIOD, 20 * MS, 50 * MS])
@pytest.mark.parametrize("late", [99 * MS, CATCH_UP, 101 * MS, 150 * MS, 999 * MS])
def test_at_most_a_tenth_of_a_second_is_made_up_for_and_the_rest_is_counted(period, late):
    paced = Paced(period)
    count = paced.after(period + late)
    assert (count - 1) * period <= CATCH_UP  # one period is due anyway
    assert count + paced.pacer.overruns == late // period + 1  # none is lost from the books
    if late <= CATCH_UP:
        assert paced.pacer.overruns == 0


def test_a_host_suspended_for_five_seconds_goes_on_at_the_old_rate(paced):
    for _ in range(10):
        paced.after(PERIOD)
    count = paced.after(5000 * MS)
    assert count == 1 + CATCH_UP // PERIOD
    assert paced.pacer.overruns == 500 - count
    assert paced.pacer.largest_late_ns == 4990 * MS
    assert [paced.after(PERIOD) for _ in range(100)] == [1] * 100
    assert paced.pacer.overruns == 500 - count


def test_the_largest_lateness_is_kept_until_it_is_set_back(paced):
    for late in (2 * MS, 7 * MS, 1 * MS):
        paced.after(PERIOD + late)
        paced.after(PERIOD - late)
    assert paced.pacer.largest_late_ns == 7 * MS
    paced.pacer.largest_late_ns = 0
    paced.after(PERIOD + MS)
    assert paced.pacer.largest_late_ns == MS


def test_after_a_restart_what_was_missed_is_neither_run_nor_counted(paced):
    paced.after(PERIOD + 5 * MS)
    paced.clock.now_ns += 3_600_000 * MS  # paused for an hour
    paced.pacer.restart()
    assert not paced.pacer.behind
    assert not paced.pacer.due()
    assert [paced.after(PERIOD) for _ in range(3)] == [1, 1, 1]
    assert (paced.pacer.overruns, paced.pacer.largest_late_ns) == (0, 0)


def test_a_long_run_with_ragged_wake_ups_keeps_the_rate_exactly(paced):
    rng = random.Random(3)
    elapsed = total = 0
    for n in range(1, 100_001):
        wake_up = n * PERIOD + rng.randrange(-PERIOD // 3, 3 * PERIOD)
        if wake_up > elapsed:
            total += paced.after(wake_up - elapsed)
            elapsed = wake_up
        assert abs(total * PERIOD - elapsed) < PERIOD  # never a period ahead or behind
    total += paced.after((elapsed // PERIOD + 1) * PERIOD - elapsed)
    assert total == elapsed // PERIOD + 1
    assert paced.pacer.overruns == 0


def test_a_period_that_is_no_whole_number_of_milliseconds_does_not_drift():
    third = 3_333_333
    paced = Paced(third)
    # woken every millisecond for an hour's worth of a thousandth
    total = sum(paced.after(MS) for _ in range(36_000))
    assert abs(total - 36_000 * MS / third) <= 1.0
