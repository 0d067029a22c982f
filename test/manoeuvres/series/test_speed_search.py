"""The search over entry speeds: the speeds that are driven, and the intervals of the events."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import InputError, Options, preset
from vehicle_roll_sim.manoeuvres.series.base import driven
from vehicle_roll_sim.manoeuvres.series.catalogue import SEARCHES, series_named
from vehicle_roll_sim.manoeuvres.series.speed_search import EVENTS, gap_of, to_the

RANGE = {"lowest_speed": 11.0, "highest_speed": 16.0, "speed_step": 2.0, "resolution": 0.3}
SHORT = {"amplitude": 8.0, "duration": 4.5}
"""A J-turn in which the reference vehicle lifts a wheel, two wheels, and rolls over from 11.6, 14.7
and 14.7 m/s on."""
NEVER = (math.nan, math.nan, math.nan)


def search(name: str = "j_turn", **values):
    return series_named(name, is_search=True).with_values(values)


def row(speed: float, *times: float, side: str = "left", end: str = "complete") -> tuple:
    return (side, speed, 3.6 * speed, 5.0, *(times or NEVER), end)


@pytest.fixture(scope="module")
def rows() -> list[tuple]:
    return list(search(**RANGE, **SHORT).rows(preset(), Options()))


def test_speeds_climb_to_the_first_rollover_and_then_halve_the_gaps(rows):
    for side in ("left", "right"):
        speeds = [row[1] for row in rows if row[0] == side]
        assert speeds[:3] == [11.0, 13.0, 15.0]  # 16 m/s is not needed any more
        assert speeds[3:6] == [12.0, 11.5, 11.75]  # the first lift-off of a wheel
        assert speeds[6] == 14.0
        assert len(speeds) == len(set(speeds))


@pytest.mark.parametrize("event", EVENTS)
def test_every_event_is_found_within_the_resolution(rows, event):
    left = {row[1]: row[1:] for row in rows if row[0] == "left"}
    below, first = gap_of(left, EVENTS[event])
    assert 0.0 < first - below <= 0.3
    text = search(**RANGE, **SHORT).remarks(preset(), rows)[f"first {event}"]
    assert text.startswith(f"between {below:.3f} and {first:.3f} m/s ({3.6 * first:.1f} km/h)")
    assert text.endswith("to either side")


def test_a_run_of_its_own_rolls_over_at_the_speed_that_is_found_and_not_below_it(rows):
    left = {row[1]: row[1:] for row in rows if row[0] == "left"}
    below, first = gap_of(left, EVENTS["rollover"])
    for speed, rolls in ((below, False), (first, True)):
        manoeuvre = dataclasses.replace(search(**SHORT).manoeuvre, speed=speed)
        simulation, _ = driven(manoeuvre, preset(), Options())
        assert math.isnan(simulation.events.rollover_time[0]) != rolls
    verdict = search().verdict(rows)
    assert verdict == f"rollover at {first:.3f} m/s ({3.6 * first:.1f} km/h), to either side"


def test_runs_to_the_right_mirror_those_to_the_left(rows):
    left, right = ([row for row in rows if row[0] == side] for side in ("left", "right"))
    for one, other in zip(left, right, strict=True):
        assert one[1] == other[1]
        assert one[3] == pytest.approx(-other[3], rel=1e-6)  # rounding, on the way to a rollover


def test_the_highest_speed_is_driven_where_the_steps_do_not_meet_it():
    speeds = search(lowest_speed=10.0, highest_speed=10.7, speed_step=0.1).speeds
    assert speeds == [10.0, 10.1, 10.2, 10.3, 10.4, 10.5, 10.6, 10.7]
    assert search(lowest_speed=10.0, highest_speed=15.0, speed_step=2.0).speeds[-2:] == [14.0, 15.0]


def test_the_lowest_speed_with_an_event_counts_whatever_happens_above_it():
    driven_rows = {speed: row(speed)[1:] for speed in (10.0, 12.0, 16.0)}
    driven_rows[14.0] = row(14.0, 1.0, 1.0, math.nan)[1:]
    assert gap_of(driven_rows, EVENTS["two-wheel lift"]) == (12.0, 14.0)
    assert gap_of(driven_rows, EVENTS["rollover"]) == (16.0, math.inf)
    assert gap_of({14.0: driven_rows[14.0]}, EVENTS["wheel lift-off"]) == (-math.inf, 14.0)


def test_lines_say_what_was_not_found_and_to_which_side():
    lifted = row(20.0, 1.0, math.nan, math.nan)
    rows = [lifted, row(20.0, side="right"), row(22.0, side="right", end="diverged")]
    remarks = search().remarks(preset(), rows)
    assert remarks["first wheel lift-off"] == (
        "already at 20.000 m/s (72.0 km/h), the lowest speed, to the left; "
        "none up to 22.000 m/s (79.2 km/h), to the right"
    )
    assert "none up to 20.000 m/s" in remarks["first rollover"]
    assert remarks["diverged"].startswith("at 22.000 m/s: ")
    assert "diverged" not in search().remarks(preset(), rows[:2])
    assert search().verdict(rows) == (
        "wheel lift-off at 20.000 m/s (72.0 km/h), to the left; "
        "no wheel lift-off up to 22.000 m/s (79.2 km/h), to the right, "
        "disregarding runs that diverged"
    )


def test_the_climb_goes_on_after_a_run_that_diverged(monkeypatch):
    ends = {10.0: "diverged", 12.0: "complete", 14.0: "rolled_over"}

    def driven_row(ready, speed, vehicle, options):
        times = (1.0, 1.0, 2.0) if ends[speed] == "rolled_over" else NEVER
        return row(speed, *times, end=ends[speed])[1:]

    monkeypatch.setattr("vehicle_roll_sim.manoeuvres.series.speed_search._row", driven_row)
    chosen = search(lowest_speed=10.0, highest_speed=18.0, speed_step=2.0, resolution=2.0)
    rows = list(chosen.rows(preset(), Options()))
    assert [row[1] for row in rows] == 2 * [10.0, 12.0, 14.0]
    assert "rollover at 14.000 m/s" in chosen.verdict(rows)


def test_a_model_without_wheel_heights_does_not_know_of_two_wheel_lift():
    chosen = search(lowest_speed=5.0, highest_speed=6.0, duration=0.2)
    rows = list(chosen.rows(preset(), Options(model="8dof")))
    assert len(rows) == 2 * 2
    said = chosen.remarks(preset(), rows)["first two-wheel lift"]
    assert said == "unknown: the model does not compute wheel heights, to either side"


@pytest.mark.parametrize("name", SEARCHES)
def test_every_manoeuvre_of_one_entry_speed_is_driven_to_either_side(name):
    """A gust is not steered: it blows the vehicle there."""
    vehicle = preset().with_values({"side_force_area": 3.0})
    ready = SEARCHES[name].manoeuvre.for_vehicle(vehicle, Options())
    for side, sign in (("left", 1.0), ("right", -1.0)):
        for given in (ready, to_the("right", ready)):
            manoeuvre = dataclasses.replace(to_the(side, given), duration=1.2)
            _, history = driven(manoeuvre, vehicle, Options())
            moved = history["y" if name == "wind_gust" else "steering"]
            assert np.sign(moved[-1]) == sign


def test_a_step_steer_keeps_the_angle_of_its_lateral_acceleration():
    """As found at the manoeuvre's own speed; with the acceleration the roll would stay the same."""
    chosen = search("iso_step_steer", lowest_speed=10.0, highest_speed=20.0, speed_step=10.0)
    rows = list(chosen.rows(preset(), Options()))
    assert abs(rows[1][3]) > 2.5 * abs(rows[0][3])  # peak roll


@pytest.mark.parametrize("highest", [5.0, 4.0])
def test_a_range_that_ends_before_it_begins_is_refused(highest):
    with pytest.raises(InputError, match=r"highest_speed.*more than lowest_speed, 5 m/s"):
        search(highest_speed=highest)


def test_a_speed_of_the_manoeuvre_is_refused_as_the_search_has_its_own():
    with pytest.raises(InputError, match=r"speed: 20.0 is not allowed: lowest_speed"):
        search(speed=20.0)


@pytest.mark.parametrize("name", ["constant_radius_circle", "iso_double_lane_change", "jturn"])
def test_a_manoeuvre_whose_speed_is_not_free_is_refused(name):
    with pytest.raises(InputError, match=f"MANOEUVRE: '{name}'"):
        series_named(name, is_search=True)
