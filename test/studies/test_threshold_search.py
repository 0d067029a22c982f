"""Brackets of thresholds on events with a known threshold."""

import math

import pytest

from vehicle_roll_sim.studies.search import brackets
from vehicle_roll_sim.studies.study import Event, Search

SEARCH = Search("manoeuvre.speed", "roll", 10.0, 30.0, 0.1, 4)
EVENT = Event("peak_roll", above=1.0)


def runs_of(threshold, unknown_above=math.inf):
    """Runs whose roll reaches 1 at a speed that depends on the point."""

    def run(points):
        rounds.append(len(points))
        return [
            {"peak_roll": None}
            if point["manoeuvre.speed"] > unknown_above
            else {"peak_roll": -point["manoeuvre.speed"] / threshold(point)}
            for point in points
        ]

    rounds = []
    return run, rounds


def test_the_threshold_is_bracketed_to_the_resolution_with_the_points_side_by_side():
    points = [{"x": x} for x in (12.3, 17.0, 29.9)]
    run, rounds = runs_of(lambda point: point["x"])
    for each in brackets(SEARCH, EVENT, points, run):
        assert each.below < each.point["x"] <= each.threshold
        assert each.threshold - each.below <= 0.1
        assert len(each.happened) == 5 + 6  # 5 in 0.08 in six halvings
    assert rounds == [15, *[3] * 6]


def test_outside_the_range_one_side_is_unknown():
    found = brackets(SEARCH, EVENT, [{"x": 5.0}, {"x": 50.0}], runs_of(lambda point: point["x"])[0])
    assert (found[0].threshold, math.isnan(found[0].below)) == (10.0, True)
    assert (math.isnan(found[1].threshold), found[1].below) == (True, 30.0)


def test_runs_that_fail_count_as_without_the_event_and_are_counted():
    (found,) = brackets(SEARCH, EVENT, [{}], runs_of(lambda point: 17.0, unknown_above=22.0)[0])
    assert found.failed == 2
    assert found.threshold == pytest.approx(17.0, abs=0.1)
