"""Heights of the features of a road, and their slopes, in coordinates of each feature.

s runs along a feature, n to the left of it, both in m. `at` is the index of its own numbers.
"""

from vehicle_roll_sim.model.compiled.jit import kernel, math, term


@term
def lift(s, start, length, rounding):
    """A rise from 0 to 1, and its slope (1/m): straight, with rounded ends.

    The slope is continuous: it grows and falls linearly over `rounding` at both ends, at most half
    of the length.
    """
    s = s - start
    if s <= 0.0:
        return 0.0, 0.0
    if s >= length:
        return 1.0, 0.0
    rounding = min(rounding, 0.5 * length)
    steepest = 1.0 / (length - rounding)
    bend = steepest / rounding
    if s < rounding:
        return 0.5 * bend * s * s, bend * s
    left = length - s
    if left < rounding:
        return 1.0 - 0.5 * bend * left * left, bend * left
    return steepest * (s - 0.5 * rounding), steepest


@kernel
def ramp(s, n, at, ground):
    """Height and slopes of what rises along s and is bounded along n.

    Its own numbers: length of the rise, height, length of the level top, length of the descent,
    where it begins to rise across and over what length, where it begins to fall across and over
    what length, and rounding (m).
    """
    length, height, top, down = ground[at], ground[at + 1], ground[at + 2], ground[at + 3]
    rounding = ground[at + 8]
    up, up_slope = lift(s, 0.0, length, rounding)
    fall, fall_slope = lift(s, length + top, down, rounding)
    left, left_slope = lift(n, ground[at + 4], ground[at + 5], rounding)
    right, right_slope = lift(n, ground[at + 6], ground[at + 7], rounding)
    along, across = up - fall, left - right
    slope_along = height * (up_slope - fall_slope) * across
    return height * along * across, slope_along, height * along * (left_slope - right_slope)


@kernel
def wave(s, at, ground):
    """Height and slope of waves h / 2 (1 - cos(2 pi s / length)) from s = 0 on.

    Its own numbers: length of a wave, height (m; negative for a dip), and number of waves.
    """
    length, height, count = ground[at], ground[at + 1], ground[at + 2]
    if s <= 0.0 or s >= count * length:
        return 0.0, 0.0
    phase = 2.0 * math.pi * s / length
    return 0.5 * height * (1.0 - math.cos(phase)), height * math.pi / length * math.sin(phase)


@term
def between(before, here, after, beyond, part, per_spacing):
    """Value and slope of the cubic through `here` and `after`, at a part (0 to 1) of the way.

    Its slopes there are those of the chords (Catmull-Rom), so that value and slope are continuous.
    per_spacing: points per m.
    """
    first, last = 0.5 * (after - before), 0.5 * (beyond - here)
    step = after - here
    quadratic, cubic = 3.0 * step - 2.0 * first - last, first + last - 2.0 * step
    value = here + part * (first + part * (quadratic + part * cubic))
    return value, (first + part * (2.0 * quadratic + 3.0 * part * cubic)) * per_spacing


@term
def cell_of(s, count, spacing):
    """The point of a table below s, and the part (0 to 1) of the way to the next one.

    The first point for nan: states may diverge within a step, before this is noticed.
    """
    if not s > 0.0:
        return 0, 0.0
    if s >= (count - 1) * spacing:
        return count - 2, 1.0
    cell = min(int(s / spacing), count - 2)
    return cell, s / spacing - cell


@term
def along_table(s, first, count, spacing, ground):
    """Value and slope at s of a table of values, one every `spacing` (m), constant beyond it."""
    cell, part = cell_of(s, count, spacing)
    before = ground[first + max(cell - 1, 0)]
    here, after = ground[first + cell], ground[first + cell + 1]
    beyond = ground[first + min(cell + 2, count - 1)]
    value, slope = between(before, here, after, beyond, part, 1.0 / spacing)
    inside = 0.0 < s < (count - 1) * spacing
    return value, slope if inside else 0.0


@kernel
def grid(s, n, at, ground):
    """Height, slopes and friction of a grid of points.

    Its own numbers: index of the table, points along and across, their spacings along and across
    (m), and whether there is a table of friction. The heights are those of one row across after the
    other, from the right to the left; the factors of friction follow in the same order.
    """
    first, along, across = int(ground[at]), int(ground[at + 1]), int(ground[at + 2])
    ahead, aside = ground[at + 3], ground[at + 4]
    cell, part = cell_of(s, along, ahead)
    rows = (max(cell - 1, 0), cell, cell + 1, min(cell + 2, along - 1))
    h0, n0 = along_table(n, first + across * rows[0], across, aside, ground)
    h1, n1 = along_table(n, first + across * rows[1], across, aside, ground)
    h2, n2 = along_table(n, first + across * rows[2], across, aside, ground)
    h3, n3 = along_table(n, first + across * rows[3], across, aside, ground)
    height, slope_along = between(h0, h1, h2, h3, part, 1.0 / ahead)
    slope_across, _ = between(n0, n1, n2, n3, part, 1.0 / ahead)
    if not 0.0 < s < (along - 1) * ahead:
        slope_along = 0.0
    friction = 1.0
    if ground[at + 5] != 0.0:
        place = first + along * across
        column, share = cell_of(n, across, aside)
        here = place + across * cell + column
        low = ground[here] + share * (ground[here + 1] - ground[here])
        here += across
        high = ground[here] + share * (ground[here + 1] - ground[here])
        friction = low + part * (high - low)
    return height, slope_along, slope_across, friction
