"""Cone strikes: a rectangle in straight, oblique and turning motion, against closed forms."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import InputError, preset
from vehicle_roll_sim.manoeuvres.body_outline import BodySettings, Outline
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History

OUTLINE = Outline(width=1.8, ahead=2.0, behind=2.5)
SPEED = 15.0
"""m/s"""
HAIR = 1e-6
"""Length (m) above rounding errors and below any relevant distance."""


def motion(time, x, y, yaw) -> History:
    rows = np.zeros((len(time), len(COLUMNS)))
    for name, values in {"time": time, "x": x, "y": y, "yaw": yaw}.items():
        rows[:, COLUMNS.index(name)] = values
    return History(rows)


def straight(heading: float = 0.0, interval: float = 0.01, aside: float = 0.0) -> History:
    """Straight motion from the origin at `SPEED`, offset sideways by `aside`."""
    time = np.arange(0.0, 2.0 + interval / 2, interval)
    way = SPEED * time
    x = way * math.cos(heading) - aside * math.sin(heading)
    y = way * math.sin(heading) + aside * math.cos(heading)
    return motion(time, x, y, heading)


def turned(places, heading: float) -> np.ndarray:
    """Positions (n, 2) rotated about the origin."""
    sine, cosine = math.sin(heading), math.cos(heading)
    return np.array(places) @ np.array([[cosine, sine], [-sine, cosine]])


@pytest.mark.parametrize("heading", [0.0, 0.4, -1.2, 3.0])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_straight_on_it_strikes_what_is_less_than_half_its_width_beside_its_way(heading, side):
    beside = side * OUTLINE.width / 2
    cones = turned([(12.0, beside - side * HAIR), (12.0, beside + side * HAIR)], heading)
    inside, outside = OUTLINE.strike_times(straight(heading), cones)
    # s: rounding
    assert inside == pytest.approx((12.0 - OUTLINE.ahead) / SPEED, abs=1e-9)
    assert math.isnan(outside)


@pytest.mark.parametrize("aside", [0.3, -0.7])
def test_shifted_sideways_it_strikes_as_much_further_to_the_side(aside):
    beyond = OUTLINE.width / 2 + aside
    cones = np.array([(12.0, beyond - HAIR), (12.0, beyond + HAIR)])
    struck = ~np.isnan(OUTLINE.strike_times(straight(aside=aside), cones))
    assert struck.tolist() == [True, False]


@pytest.mark.parametrize("interval", [0.01, 0.1, 0.5])
def test_between_samples_no_cone_is_passed_over_and_the_time_is_that_of_the_motion(interval):
    places = np.linspace(3.0, 25.0, 97)
    cones = np.column_stack((places, np.zeros(len(places))))
    times = OUTLINE.strike_times(straight(interval=interval), cones)
    np.testing.assert_allclose(times, (places - OUTLINE.ahead) / SPEED, rtol=0, atol=1e-9)


def test_what_it_does_not_get_to_and_what_lies_behind_it_is_not_struck():
    reach = 2.0 * SPEED + OUTLINE.ahead
    cones = np.array([(reach + HAIR, 0.0), (reach - HAIR, 0.0), (-OUTLINE.behind - HAIR, 0.0)])
    struck = ~np.isnan(OUTLINE.strike_times(straight(), cones))
    assert struck.tolist() == [False, True, False]


def test_a_cone_under_the_body_from_the_beginning_is_struck_at_once():
    times = OUTLINE.strike_times(straight(), np.array([(-1.0, 0.5)]))
    assert times.tolist() == [0.0]


def test_turning_on_the_spot_it_sweeps_the_circle_of_its_corners():
    corner = math.hypot(OUTLINE.behind, OUTLINE.width / 2)
    time = np.arange(0.0, 2.0, 0.01)
    spin = motion(time, np.zeros(len(time)), np.zeros(len(time)), math.pi * time)
    directions = np.linspace(0.1, 6.2, 40)
    ring = np.column_stack((np.cos(directions), np.sin(directions)))
    # between samples a cone goes straight on: r (1 - cos(0.0157)) = 0.33 mm inside its circle
    radii = (corner - HAIR, corner + 4e-4)
    struck = [~np.isnan(OUTLINE.strike_times(spin, r * ring)) for r in radii]
    assert struck[0].all()
    assert not struck[1].any()


def test_the_rear_corner_swings_out_where_the_front_would_have_passed():
    """In a turn about a point beside the vehicle, the rear corner strikes a cone beside it."""
    radius, rate = 8.0, 0.5
    time = np.arange(0.0, 1.5, 0.01)
    yaw = rate * time
    turn = motion(time, radius * np.sin(yaw), radius * (1.0 - np.cos(yaw)), yaw)
    outer = math.hypot(radius + OUTLINE.width / 2, OUTLINE.behind)
    bearing = -math.pi / 2  # beside the c.g. at the beginning, 2.5 m ahead of the rear corner
    reach = math.hypot(radius + OUTLINE.width / 2, OUTLINE.ahead)
    assert outer > reach
    cones = [
        (r * math.cos(bearing + 0.3), radius + r * math.sin(bearing + 0.3))
        for r in (reach + 0.01, outer - 0.01, outer + 0.01)
    ]
    struck = ~np.isnan(OUTLINE.strike_times(turn, np.array(cones)))
    assert struck.tolist() == [True, True, False]


def test_a_run_of_one_sample_strikes_nothing():
    assert np.isnan(OUTLINE.strike_times(straight(interval=5.0), np.array([(1.0, 0.0)]))).all()


def test_unless_told_otherwise_the_body_is_as_wide_as_the_larger_track_and_a_tire():
    vehicle = preset().with_values({"front_track": 1.4})
    outline = BodySettings().outline_of(vehicle)
    assert outline.width == pytest.approx(1.5 + 0.205, abs=1e-12)
    assert outline.ahead == pytest.approx(1.016 + 0.8, abs=1e-12)
    assert outline.behind == pytest.approx(1.524 + 0.9, abs=1e-12)
    assert BodySettings(vehicle_width=1.9).outline_of(vehicle).width == 1.9


def test_a_body_narrower_than_the_track_is_refused():
    with pytest.raises(InputError, match=r"1.4 .*at least the larger track width, 1.5 m"):
        BodySettings(vehicle_width=1.4).outline_of(preset())
