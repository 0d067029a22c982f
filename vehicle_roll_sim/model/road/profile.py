"""A profile: heights along two tracks, with a smooth transition from one to the other.

Its own numbers: index of the table, points of a track, their spacing, and places of the left and
the right track across (m). The table has, point by point, the height of the left and of the right
track; the first and the last points stand twice in it, as neighbours for the cubics there.

Heights are looked up under all wheels together: short loops without calls, most of which the
compiler vectorizes.
"""

from vehicle_roll_sim.model.compiled.jit import kernel, not_unrolled, term
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.road.layout import COSINE, ORIGIN_X, ORIGIN_Y, OWN, SINE
from vehicle_roll_sim.model.road.shapes import between, lift
from vehicle_roll_sim.model.work_space import POINTS_OF_PROFILE, TRACKS


@term
def within(s, length):
    """The nearest place from 0 to a length; 0 for nan."""
    return min(max(0.0, s), length)


@term
def surface_of_profile(s, n, part, left, right, of_track):
    """Height and slopes at s, n, from four neighbours on each track.

    part: of the way from the second neighbour to the third. left, right: heights of the neighbours
    (m). of_track: length of the table (m), its points per m, and places of the left and the right
    track across (m).
    """
    length, per_spacing, on_left, on_right = of_track
    left, left_slope = between(left[0], left[1], left[2], left[3], part, per_spacing)
    right, right_slope = between(right[0], right[1], right[2], right[3], part, per_spacing)
    width = on_left - on_right
    share, share_slope = lift(n, on_right, width, 0.5 * width)
    apart = left - right
    along = right_slope + share * (left_slope - right_slope)
    along = along if 0.0 < s < length else 0.0
    return right + share * apart, along, share_slope * apart


@kernel
def profile(s, n, at, ground):
    """Height and slopes at one point."""
    first, count, spacing = int(ground[at]), int(ground[at + 1]), ground[at + 2]
    length, per_spacing = (count - 1) * spacing, 1.0 / spacing
    place = within(s, length) * per_spacing
    cell = min(int(place), count - 2)
    begin = first + TRACKS * cell
    p = ground[begin : begin + POINTS_OF_PROFILE]
    left, right = (p[0], p[2], p[4], p[6]), (p[1], p[3], p[5], p[7])
    of_track = (length, per_spacing, ground[at + 3], ground[at + 4])
    return surface_of_profile(s, n, place - cell, left, right, of_track)


@kernel
def add_profile_under_wheels(row, ground, terms):
    """Add height and slopes of the feature that begins at `row` to those under the wheels."""
    at = row + OWN
    first, count, spacing = int(ground[at]), int(ground[at + 1]), ground[at + 2]
    length, per_spacing = (count - 1) * spacing, 1.0 / spacing
    x0, y0 = ground[row + ORIGIN_X], ground[row + ORIGIN_Y]
    c, sine = ground[row + COSINE], ground[row + SINE]
    of_track = (length, per_spacing, ground[at + 3], ground[at + 4])
    for i in range(not_unrolled(WHEEL_COUNT)):
        ahead, aside = terms.place_x[i] - x0, terms.place_y[i] - y0
        s = c * ahead + sine * aside
        terms.distance[i], terms.aside[i] = s, c * aside - sine * ahead
        terms.part[i] = within(s, length) * per_spacing
    for i in range(WHEEL_COUNT):
        cell = min(int(terms.part[i]), count - 2)
        terms.part[i] -= cell
        begin = first + TRACKS * cell
        near = ground[begin : begin + POINTS_OF_PROFILE]  # read faster than the whole
        for j in range(POINTS_OF_PROFILE):
            terms.points[j, i] = near[j]
    p = terms.points
    for i in range(not_unrolled(WHEEL_COUNT)):
        height, slope_x, slope_y = terms.height[i], terms.slope_x[i], terms.slope_y[i]
        left, right = (p[0, i], p[2, i], p[4, i], p[6, i]), (p[1, i], p[3, i], p[5, i], p[7, i])
        s, n, part = terms.distance[i], terms.aside[i], terms.part[i]
        h, along, across = surface_of_profile(s, n, part, left, right, of_track)
        terms.height[i] = height + h
        terms.slope_x[i] = slope_x + (c * along - sine * across)
        terms.slope_y[i] = slope_y + (sine * along + c * across)
