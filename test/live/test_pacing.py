"""Pacing by a clock: every period runs once, and late periods are caught up within a limit."""

import math
import random

import pytest

from vehicle_roll_sim.live.pacing import Pacer

pytestmark = pytest.mark.unmeasured

MS = 1_000_000
PERIOD = 10 * MS
CATCH_UP = 100 * MS
"""ns: at most so much is made up for."""


class FakeClock:
    """A clock that goes on when it is told to, or while somebody sleeps by it."""

    def __init__(self):
        self.now_ns = 123_456_789

    def __call__(self) -> int:
        return self.now_ns

    def sleep(self, seconds: float) -> None:
        self.now_ns += round(seconds * 1e9)


class Paced:
    """A pacer on a fake clock."""

    def __init__(self, period_ns: int = PERIOD, factor: float = 1.0, catch_up: float = 0.1):
        self.clock = FakeClock()
        self.pacer = Pacer(period_ns, factor, catch_up, self.clock, self.clock.sleep)

    def after(self, ns: int) -> int:
        """Periods that are run when another `ns` have passed: the due one, and those behind it."""
        self.clock.now_ns += ns
        count = 0
        while self.pacer.due():
            count += 1
        return count

    def largest_lateness(self) -> float:
        """ms"""
        return self.pacer.lateness()[2] * 1e3


@pytest.fixture
def paced() -> Paced:
    return Paced()


def test_the_first_period_is_due_one_period_after_the_start(paced):
    assert [paced.after(0), paced.after(PERIOD - 1), paced.after(1)] == [0, 0, 1]


def test_on_time_every_period_is_run_once(paced):
    assert [paced.after(PERIOD) for _ in range(1000)] == [1] * 1000
    assert (paced.largest_lateness(), paced.pacer.overruns) == (0.0, 0)


def test_nothing_is_due_again_at_the_same_time(paced):
    assert [paced.after(PERIOD), paced.after(0), paced.after(0)] == [1, 0, 0]


def test_a_call_that_comes_a_little_late_does_not_move_the_next_deadline(paced):
    assert paced.after(PERIOD + 3 * MS) == 1
    assert paced.after(PERIOD - 3 * MS) == 1
    assert paced.largest_lateness() == pytest.approx(3.0)


def test_periods_that_were_missed_are_made_up_for_one_by_one(paced):
    assert paced.after(4 * PERIOD + MS) == 4
    assert paced.largest_lateness() == pytest.approx(31.0)
    assert paced.pacer.overruns == 0
    assert paced.after(PERIOD - MS) == 1


def test_a_wake_up_too_early_runs_nothing(paced):
    assert [paced.after(PERIOD - 1), paced.after(1)] == [0, 1]


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
    assert paced.largest_lateness() == pytest.approx(4990.0)
    assert [paced.after(PERIOD) for _ in range(100)] == [1] * 100
    assert paced.pacer.overruns == 500 - count


@pytest.mark.parametrize("catch_up", [0.0, 0.05, 1.0])
def test_how_much_is_made_up_for_can_be_chosen(catch_up):
    paced = Paced(catch_up=catch_up)
    assert paced.after(5000 * MS) == 1 + round(catch_up / 0.01)
    assert paced.pacer.overruns == 499 - round(catch_up / 0.01)


def test_lateness_is_told_by_its_percentiles_since_it_was_last_asked_for(paced):
    for late in range(1, 102):  # µs
        paced.after(PERIOD + 1000 * late)
        paced.clock.now_ns -= 1000 * late
    assert paced.pacer.lateness() == pytest.approx((51e-6, 100e-6, 101e-6))
    assert all(map(math.isnan, paced.pacer.lateness()))
    paced.after(PERIOD + MS)
    assert paced.pacer.lateness() == pytest.approx((1e-3, 1e-3, 1e-3))


def test_after_a_restart_what_was_missed_is_neither_run_nor_counted(paced):
    paced.after(PERIOD + 5 * MS)
    paced.clock.now_ns += 3_600_000 * MS  # paused for an hour
    paced.pacer.restart()
    assert not paced.pacer.due()
    assert [paced.after(PERIOD) for _ in range(3)] == [1, 1, 1]
    assert (paced.pacer.overruns, paced.largest_lateness()) == (0, 0.0)


def test_a_long_run_with_ragged_wake_ups_keeps_the_rate_exactly(paced):
    rng = random.Random(3)
    elapsed = total = 0
    for n in range(1, 100_001):
        wake_up = n * PERIOD + rng.randrange(-PERIOD // 3, 3 * PERIOD)
        if wake_up > elapsed:
            total += paced.after(wake_up - elapsed)
            elapsed = wake_up
        assert 0 <= elapsed - total * PERIOD < PERIOD  # never ahead, never a period behind
    assert paced.pacer.overruns == 0


@pytest.mark.parametrize("factor", [0.1, 0.3, 1.0, 3.0, 100.0])
def test_neither_odd_periods_nor_factors_drift(factor):
    third = 3_333_333
    paced = Paced(third, factor)
    # woken every millisecond for an hour's worth of a thousandth
    total = sum(paced.after(MS) for _ in range(36_000))
    assert abs(total - 36_000 * MS * factor / third) <= 1.0


def test_waiting_ends_at_the_deadline_and_sees_the_world_in_between(paced):
    paced.pacer.wait()
    assert paced.clock.now_ns == 123_456_789 + PERIOD
    slow = Paced(10_000 * MS)
    slow.pacer.wait()
    assert slow.clock.now_ns - 123_456_789 == 100 * MS  # a nap, then a look


def test_as_fast_as_possible_is_always_due_and_rests_now_and_then():
    paced = Paced(factor=0.0)
    began = paced.clock.now_ns
    for _ in range(1000):
        paced.pacer.wait()
        assert paced.pacer.due()
        paced.clock.now_ns += MS  # the work of a period
    rests = paced.clock.now_ns - began - 1000 * MS
    assert 100 * 100_000 < rests < 250 * 100_000  # some 100 µs every 5 to 6 ms
    assert paced.pacer.overruns == 0
    assert all(map(math.isnan, paced.pacer.lateness()))
