"""Limits, counts and the worst run, of results that are put together."""

import math

import pytest
from constructed import history, outcome

from vehicle_roll_sim.scoring import tables
from vehicle_roll_sim.scoring.driven import Driven
from vehicle_roll_sim.scoring.plan import Ladder
from vehicle_roll_sim.scoring.results import Climb, Score, result_alone, result_controlled

LEVELS = (30.0, 40.0, 50.0)


def result(level: float, roll: float, fails: bool, seconds: float = 1.0, notes=()):
    """A run in which the roll angle is constant (rad), with a controller."""
    run = outcome(history(seconds, roll=roll), has_failed=fails)
    return result_controlled(level, run, run, Driven(None, run.warned, notes))


def climb(fails_alone: float, fails: float, variant="nominal", side="left", **settings) -> Climb:
    """A climb that fails from some level on, alone and with the controller."""
    ladder = Ladder("fishhook", variant, side, LEVELS)
    alone = {
        level: result_alone(level, outcome(history(1.0, roll=0.2), has_failed=level >= fails_alone))
        for level in LEVELS
    }
    driven = [level for level in LEVELS if level <= fails]
    controlled = {
        level: result(level, 0.1 + level / 1e3, level >= fails, **settings) for level in driven
    }
    return Climb(ladder, alone, controlled)


@pytest.mark.parametrize(
    ("fails_alone", "fails", "compared"),
    [(40.0, 50.0, 40.0), (40.0, math.inf, 40.0), (50.0, 30.0, 30.0), (math.inf, math.inf, 50.0)],
)
def test_both_are_compared_at_the_lower_limit_or_the_highest_level(fails_alone, fails, compared):
    found = climb(fails_alone, fails)
    assert (found.limit_alone, found.limit, found.compared) == (fails_alone, fails, compared)
    assert [each.level for each in found.pair] == [compared, compared]


SCORE = Score(
    "mine",
    (
        climb(40.0, math.inf),
        climb(40.0, 40.0, side="right"),
        climb(50.0, 30.0, "heavy", notes=("brakes: 3 dropped",)),
        climb(30.0, 40.0, "light", notes=("brakes: 3 dropped",)),
    ),
)


def test_the_summary_counts_limits_that_are_raised_unchanged_and_lowered():
    (row,) = tables.summary_table([SCORE]).rows
    assert row[:4] == ["`mine`", "2 of 4", "1", "1"]
    assert row[-1] == "none"


def test_a_row_says_why_a_controller_was_not_scored():
    row = tables.summary_table([Score("mine", (), "mine ended with status 1")]).rows[0]
    assert row[1] == "not scored: mine ended with status 1"
    assert len(row) == len(tables.SUMMARY)
    assert tables.table_of_test("fishhook", [Score("mine", (), "it ended")]).rows == []


def test_the_lowest_limits_over_sides_and_variants_are_shown():
    (row,) = tables.table_of_test("fishhook", [SCORE]).rows
    assert row[1:4] == ["40 mph → 40 mph", "30 mph → 30 mph", "40 mph"]
    assert row[4] == "11.5 → 8.0 deg"  # 0.2 and 0.14 rad
    rows = tables.spread_table("fishhook", [SCORE]).rows
    assert rows == [
        ["`nominal`", "40 mph", "40 mph"],
        ["`light`", "30 mph", "40 mph"],
        ["`heavy`", "50 mph", "30 mph"],
    ]


def test_of_a_test_with_one_level_the_roll_angles_of_variants_are_shown():
    one = climb(math.inf, math.inf)
    ladder = Ladder("step", "nominal", "left", LEVELS[:1])
    single = Climb(ladder, {30.0: one.alone[30.0]}, {30.0: one.controlled[30.0]})
    (row,) = tables.spread_table("step", [Score("mine", (single,))]).rows
    assert row == ["`nominal`", "11.5 deg", "7.4 deg"]  # 0.2 and 0.13 rad


def test_notes_are_told_once_with_the_number_of_runs():
    assert SCORE.notes == ["brakes: 3 dropped (3 runs)"]


def test_the_worst_run_has_the_largest_roll_angle_and_of_rollovers_is_over_first():
    assert SCORE.worst == (SCORE.climbs[0].ladder, 50.0)
    late, early = climb(40.0, 30.0), climb(40.0, 30.0, side="right")
    rolled = [
        Climb(each.ladder, each.alone, {30.0: result(30.0, roll, True, seconds)})
        for each, roll, seconds in ((late, 1.4837, 2.0), (early, 1.4835, 1.5))
    ]
    assert Score("mine", tuple(rolled)).worst == (early.ladder, 30.0)
