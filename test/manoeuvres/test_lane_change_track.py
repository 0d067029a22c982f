"""The tracks of ISO 3888: lengths, widths and positions of the lanes, cones, and the path."""

import numpy as np
import pytest

from vehicle_roll_sim.manoeuvres.lane_change_track import (
    double_lane_change_track,
    obstacle_avoidance_track,
)

WIDTHS = (1.5, 1.7, 2.0, 2.5)
"""m: with more than 2.115 m the last lane of ISO 3888-2 is wider than 3 m."""
LAYOUTS = (obstacle_avoidance_track, double_lane_change_track)
ROUNDING = 1e-12
"""m"""


def widths_of(track) -> list[float]:
    return [lane.left - lane.right for lane in track.lanes]


@pytest.mark.parametrize("width", WIDTHS)
def test_lanes_of_the_obstacle_avoidance_have_the_lengths_and_widths_of_the_standard(width):
    track = obstacle_avoidance_track(width)
    ends = [place for lane in track.lanes for place in (lane.start, lane.end)]
    assert np.diff(ends).tolist() == [12.0, 13.5, 11.0, 12.5, 12.0]
    assert (ends[0], track.end) == (0.0, 61.0)
    expected = [1.1 * width + 0.25, width + 1.0, max(1.3 * width + 0.25, 3.0)]
    assert widths_of(track) == pytest.approx(expected, abs=ROUNDING)


@pytest.mark.parametrize("width", WIDTHS)
def test_the_second_lane_of_the_obstacle_avoidance_is_1_m_beside_the_others(width):
    first, second, last = obstacle_avoidance_track(width).lanes
    assert second.right - first.left == pytest.approx(1.0, abs=ROUNDING)
    assert second.right - last.left == pytest.approx(1.0, abs=ROUNDING)
    assert first.middle == 0.0


@pytest.mark.parametrize("width", WIDTHS)
def test_lanes_of_the_double_lane_change_have_the_lengths_and_widths_of_the_standard(width):
    track = double_lane_change_track(width)
    ends = [place for lane in track.lanes for place in (lane.start, lane.end)]
    assert np.diff(ends).tolist() == [15.0, 30.0, 25.0, 25.0, 30.0]
    assert (ends[0], track.end) == (0.0, 125.0)
    expected = [1.1 * width + 0.25, 1.2 * width + 0.25, 1.3 * width + 0.25]
    assert widths_of(track) == pytest.approx(expected, abs=ROUNDING)
    rights = [lane.right for lane in track.lanes]
    assert rights[1] - rights[0] == pytest.approx(3.5, abs=ROUNDING)
    assert rights[2] == rights[0]
    assert track.lanes[0].middle == 0.0


@pytest.mark.parametrize("layout", LAYOUTS)
def test_cones_stand_at_the_beginning_middle_and_end_of_both_borders_of_every_lane(layout):
    track = layout(1.7)
    expected = {
        (x, y)
        for lane in track.lanes
        for x in (lane.start, (lane.start + lane.end) / 2, lane.end)
        for y in (lane.left, lane.right)
    }
    assert len(track.cones) == 18
    assert set(map(tuple, track.cones.tolist())) == expected


@pytest.mark.parametrize("layout", LAYOUTS)
def test_to_the_right_the_track_is_the_mirror_image(layout):
    left, right = layout(1.7), layout(1.7, -1.0)
    x = np.linspace(-20.0, 150.0, 1001)
    np.testing.assert_array_equal(right.path(x), -left.path(x))
    np.testing.assert_array_equal(right.cones, left.cones * (1.0, -1.0))


@pytest.mark.parametrize("layout", LAYOUTS)
def test_the_path_is_the_middle_of_each_lane_and_straight_on_before_and_behind(layout):
    track = layout(1.7)
    for lane in track.lanes:
        inside = np.linspace(lane.start, lane.end, 50)
        np.testing.assert_allclose(track.path(inside), lane.middle, rtol=0, atol=ROUNDING)
    assert track.path(np.array([-100.0]))[0] == track.lanes[0].middle
    behind = track.path(np.array([track.end + 100.0]))[0]
    assert behind == pytest.approx(track.lanes[-1].middle, abs=ROUNDING)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_the_path_has_no_step_in_direction_or_curvature(layout):
    track, spacing = layout(1.7), 0.01
    x = np.arange(-1.0, track.end + 1.0, spacing)
    slope = np.diff(track.path(x)) / spacing
    bend = np.diff(slope) / spacing
    # 60 h / L^3 is the largest third derivative of that curve: of a change by h over a length L
    steepest = max(
        60.0 * abs(after.middle - before.middle) / (after.start - before.end) ** 3
        for before, after in zip(track.lanes, track.lanes[1:], strict=False)
    )
    assert np.abs(np.diff(bend)).max() <= 1.01 * steepest * spacing


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_lane_is_missed_by_who_is_beside_it_anywhere_along_it(layout, side):
    track = layout(1.7, side)
    x = np.linspace(-5.0, track.end + 5.0, 2001)
    assert track.missed_lanes(x, track.path(x)) == [False, False, False]
    assert track.missed_lanes(x, np.zeros(len(x))) == [False, True, False]
    last = track.lanes[2]
    aside = np.where(x > last.end - 1.0, side * (last.left + 0.01), track.path(x))
    assert track.missed_lanes(x, aside) == [False, False, True]
    assert track.missed_lanes(x, np.where(x > last.end, 50.0, track.path(x))) == [False] * 3
