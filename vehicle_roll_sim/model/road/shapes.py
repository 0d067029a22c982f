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
    if s < rounding:
        return 0.5 * steepest * s * s / rounding, steepest * s / rounding
    left = length - s
    if left < rounding:
        return 1.0 - 0.5 * steepest * left * left / rounding, steepest * left / rounding
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
def between(before, here, after, beyond, part, spacing):
    """Value and slope of the cubic through `here` and `after`, at a part (0 to 1) of the way.

    Its slopes there are those of the chords (Catmull-Rom), so that value and slope are continuous.
    """
    first, last = 0.5 * (after - before), 0.5 * (beyond - here)
    step = after - here
    quadratic, cubic = 3.0 * step - 2.0 * first - last, first + last - 2.0 * step
    value = here + part * (first + part * (quadratic + part * cubic))
    return value, (first + part * (2.0 * quadratic + 3.0 * part * cubic)) / spacing


@term
def clamped(index, count):
    """An index of a table of `count` values."""
    return min(max(index, 0), count - 1)


@term
def cell_of(s, count, spacing):
    """The point of a table below s, and the part (0 to 1) of the way to the next one."""
    if s <= 0.0:
        return 0, 0.0
    if s >= (count - 1) * spacing:
        return count - 2, 1.0
    cell = min(int(s / spacing), count - 2)
    return cell, s / spacing - cell


@term
def along_table(s, first, count, spacing, stride, ground):
    """Value and slope at s of a table of values, one every `spacing` (m), constant beyond it."""
    cell, part = cell_of(s, count, spacing)
    before = ground[first + stride * max(cell - 1, 0)]
    here, after = ground[first + stride * cell], ground[first + stride * (cell + 1)]
    beyond = ground[first + stride * min(cell + 2, count - 1)]
    value, slope = between(before, here, after, beyond, part, spacing)
    inside = 0.0 < s < (count - 1) * spacing
    return value, slope if inside else 0.0


@kernel
def profile(s, n, at, ground):
    """Height and slopes of two tracks, with a smooth transition from one to the other.

    Its own numbers: index of the table, points of a track, their spacing, and places of the left
    and the right track across (m). The table has the heights of the left, then of the right track.
    """
    first, count, spacing = int(ground[at]), int(ground[at + 1]), ground[at + 2]
    on_left, on_right = ground[at + 3], ground[at + 4]
    left, left_slope = along_table(s, first, count, spacing, 1, ground)
    right, right_slope = along_table(s, first + count, count, spacing, 1, ground)
    width = on_left - on_right
    share, share_slope = lift(n, on_right, width, 0.5 * width)
    height = right + share * (left - right)
    slope_along = right_slope + share * (left_slope - right_slope)
    return height, slope_along, share_slope * (left - right)


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
    h0, n0 = along_table(n, first + across * rows[0], across, aside, 1, ground)
    h1, n1 = along_table(n, first + across * rows[1], across, aside, 1, ground)
    h2, n2 = along_table(n, first + across * rows[2], across, aside, 1, ground)
    h3, n3 = along_table(n, first + across * rows[3], across, aside, 1, ground)
    height, slope_along = between(h0, h1, h2, h3, part, ahead)
    slope_across, _ = between(n0, n1, n2, n3, part, ahead)
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
