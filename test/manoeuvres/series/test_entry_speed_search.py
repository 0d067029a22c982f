"""The highest entry speed: the speeds that are driven, and the result."""

import dataclasses
import math

import pytest

from vehicle_roll_sim import Options, preset
from vehicle_roll_sim.manoeuvres.series.base import driven
from vehicle_roll_sim.manoeuvres.series.catalogue import SERIES
from vehicle_roll_sim.manoeuvres.series.entry_speed_search import EntrySpeedSearch

pytestmark = pytest.mark.unmeasured

SEVERE, PLAIN = "iso_severe_double_lane_change", "iso_double_lane_change"
PLAUSIBLE = {SEVERE: (45, 65), PLAIN: (70, 110)}
"""km/h: a passenger car with a high c.g. and much grip, and a driver of the simplest kind."""
SLOWEST = {SEVERE: 45, PLAIN: 80}
"""km/h: where the series begin here; slower runs have tests of their own."""


@pytest.fixture(scope="module", params=[SEVERE, PLAIN])
def searched(request) -> tuple[str, list[tuple]]:
    """Name and rows of the reference vehicle's series."""
    name = request.param
    series = dataclasses.replace(SERIES[name], slowest=SLOWEST[name])
    return name, list(series.rows(preset(), Options()))


def is_passed(row) -> bool:
    return row[2] == 0 and row[-1] == "complete"


def found_in(name: str, rows) -> dict[str, int]:
    """The speed that the verdict gives for each side."""
    parts = SERIES[name].verdict(rows).split(", ")
    return {part.split()[-1]: int(part.split()[0]) for part in parts}


def test_the_reference_vehicle_has_a_plausible_entry_speed_to_either_side(searched):
    name, rows = searched
    found = found_in(name, rows)
    low, high = PLAUSIBLE[name]
    assert low <= found["left"] <= high
    assert found["left"] == found["right"]


def test_speeds_climb_by_5_to_the_first_failure_and_then_by_1_to_the_next(searched):
    name, rows = searched
    for side, found in found_in(name, rows).items():
        speeds = [row[1] for row in rows if row[0] == side]
        passed = [row[1] for row in rows if row[0] == side and is_passed(row)]
        last = speeds.index(max(speeds))
        assert speeds[: last + 1] == list(range(SLOWEST[name], max(speeds) + 1, 5))
        below = max(speeds) - 5
        assert speeds[last + 1 :] == list(range(below + 1, min(found + 1, max(speeds) - 1) + 1))
        assert max(passed) == found


def test_the_speed_that_is_found_passes_and_one_km_h_more_fails(searched):
    name, rows = searched
    found = found_in(name, rows)["left"]
    for speed, expected in ((found, True), (found + 1, False)):
        manoeuvre = dataclasses.replace(SERIES[name].manoeuvre, speed=speed / 3.6)
        ready = manoeuvre.for_vehicle(preset(), Options())
        simulation, history = driven(ready, preset(), Options())
        is_upright = math.isnan(simulation.events.rollover_time[0])
        assert (ready.result(history).is_passed and is_upright) == expected


def test_runs_to_the_right_mirror_those_to_the_left(searched):
    _, rows = searched
    half = len(rows) // 2
    for left, right in zip(rows[:half], rows[half:], strict=True):
        assert (left[0], right[0]) == ("left", "right")
        assert right[1:3] == left[1:3]
        assert right[4] == pytest.approx(-left[4], abs=1e-5)  # deg


def row(side: str, speed: int, cones: int = 0, end: str = "complete") -> tuple:
    return side, speed, cones, 0.3, 5.0, math.nan, 40.0, end


def test_the_verdict_is_the_highest_speed_below_every_failure():
    rows = [
        *(row("left", 20), row("left", 25), row("left", 30, cones=2)),
        *(row("left", 26), row("left", 27, end="rolled_over")),
        *(row("right", 20, cones=1),),
    ]
    expected = "26 km/h to the left, failed already at 20 km/h to the right"
    assert SERIES[SEVERE].verdict(rows) == expected


def test_without_a_failure_the_verdict_says_how_far_it_was_driven():
    rows = [row("left", 145), row("left", 150), row("right", 150)]
    none = "no failure up to 150 km/h to the"
    assert SERIES[SEVERE].verdict(rows) == f"{none} left, {none} right"


@pytest.mark.parametrize(
    ("failing", "driven_speeds"),
    [
        (lambda v: v >= 33, [20, 25, 30, 35, 31, 32, 33]),
        (lambda v: v == 35, [20, 25, 30, 35, 31, 32, 33, 34]),
        (lambda v: v >= 20, [20]),
        (lambda v: False, [20, 25, 30, 35, 40]),
    ],
)
def test_the_search_drives_what_it_must_and_no_more(monkeypatch, failing, driven_speeds):
    search = EntrySpeedSearch(SERIES[SEVERE].manoeuvre, 20, 40)

    def pretend(self, ready, speed, vehicle, options):
        return row("", speed, cones=int(failing(speed)))[1:]

    monkeypatch.setattr(EntrySpeedSearch, "_row", pretend)
    rows = list(search.rows(preset(), Options()))
    assert [r[1] for r in rows if r[0] == "left"] == driven_speeds
    assert [r[1] for r in rows if r[0] == "right"] == driven_speeds


def test_a_lower_vehicle_does_not_change_the_track_but_a_wider_one_does():
    search = SERIES[SEVERE].with_values({"vehicle_width": 2.0})
    ready = search.manoeuvre.for_vehicle(preset(), Options())
    assert ready.track.lanes[1].left - ready.track.lanes[1].right == pytest.approx(3.0)
