"""The surface of the road: height, slope and friction at any point, as the sum of its features."""

from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.road.banked_curve import banked_curve
from vehicle_roll_sim.model.road.layout import (
    BANKED_CURVE,
    CHESSBOARD,
    COSINE,
    COUNT,
    FEATURE_SIZE,
    GRID,
    HEADER,
    KIND,
    ORIGIN_X,
    ORIGIN_Y,
    OWN,
    PROFILE,
    RAMP,
    SINE,
    SOIL,
    TILT,
    TILT_COUNT,
    WAVE,
)
from vehicle_roll_sim.model.road.shapes import grid, lift, profile, ramp, wave


@term
def row_of(k, ground):
    """Index of the first number of feature k."""
    return HEADER + FEATURE_SIZE * k


@term
def in_feature(x, y, row, ground):
    """A point of the ground frame in the coordinates s, n of a feature (m)."""
    ahead, aside = x - ground[row + ORIGIN_X], y - ground[row + ORIGIN_Y]
    c, s = ground[row + COSINE], ground[row + SINE]
    return c * ahead + s * aside, c * aside - s * ahead


@term
def is_within(s, n, at, ground):
    """Whether a point is in a rectangle: 0 to its length along, and from right to left across.

    at: index of the length; right and left (m) follow.
    """
    return 0.0 <= s < ground[at] and ground[at + 1] <= n < ground[at + 2]


@kernel
def friction_of(kind, s, n, at, ground):
    """Factor of friction of a patch or a chessboard at a point.

    Numbers of a patch: length, right, left (m), factor. Of a chessboard: these, with the factor of
    the first square, then that of the others, and length and width of a square (m).
    """
    if not is_within(s, n, at, ground):
        return 1.0
    if kind == CHESSBOARD:
        column = math.floor(s / ground[at + 5]) + math.floor((n - ground[at + 1]) / ground[at + 6])
        return ground[at + 3] if column % 2 == 0 else ground[at + 4]
    return ground[at + 3]


@kernel
def surface(x, y, ground):
    """Height (m), slopes dh/dx and dh/dy, and factor of friction at a point of the ground frame.

    Heights of features add up, and their factors of friction are multiplied.
    """
    height, along, across, friction = 0.0, 0.0, 0.0, 1.0
    for k in range(int(ground[COUNT])):
        row = row_of(k, ground)
        kind, at = ground[row + KIND], row + OWN
        s, n = in_feature(x, y, row, ground)
        h, slope_s, slope_n = 0.0, 0.0, 0.0
        if kind == PROFILE:
            h, slope_s, slope_n = profile(s, n, at, ground)
        elif kind <= CHESSBOARD:
            friction *= friction_of(kind, s, n, at, ground)
        elif kind == RAMP:
            h, slope_s, slope_n = ramp(s, n, at, ground)
        elif kind == WAVE:
            h, slope_s = wave(s, at, ground)
        elif kind == BANKED_CURVE:
            h, slope_s, slope_n = banked_curve(s, n, at, ground)
        elif kind == GRID:
            h, slope_s, slope_n, factor = grid(s, n, at, ground)
            friction *= factor
        c, sine = ground[row + COSINE], ground[row + SINE]
        height += h
        along += c * slope_s - sine * slope_n
        across += sine * slope_s + c * slope_n
    return height, along, across, friction


@kernel
def softness(x, y, ground):
    """Compliance of the ground (m/N), and its resistances (N/m and N/m^2) to a wheel in a furrow.

    Numbers of soft soil: length, right, left (m), compliance (m/N), both resistances, and rounding
    (m): the compliance grows from 0 at the edges.
    """
    yielding, linear, quadratic = 0.0, 0.0, 0.0
    for k in range(int(ground[COUNT])):
        row = row_of(k, ground)
        if ground[row + KIND] != SOIL:
            continue
        at = row + OWN
        s, n = in_feature(x, y, row, ground)
        if not is_within(s, n, at, ground):
            continue
        rounding = ground[at + 6]
        share = 1.0
        for distance in (s, ground[at] - s, n - ground[at + 1], ground[at + 2] - n):
            part, _ = lift(distance, 0.0, rounding, 0.5 * rounding)
            share *= part
        yielding += share * ground[at + 3]
        linear, quadratic = linear + ground[at + 4], quadratic + ground[at + 5]
    return yielding, linear, quadratic


@kernel
def sample(points, ground, found):
    """Fill `found`, shape (n, 3), at points x, y of the ground frame, shape (n, 2).

    With height (m), factor of friction, and compliance (m/N).
    """
    for k in range(len(points)):
        x, y = points[k, 0], points[k, 1]
        found[k, 0], _, _, found[k, 1] = surface(x, y, ground)
        found[k, 2], _, _ = softness(x, y, ground)


@kernel
def tilt_angle(time, ground):
    """Angle of a tilting ground (rad), its left side raised, from its table; 0 if it has none."""
    first, count = int(ground[TILT]), int(ground[TILT_COUNT])
    if count == 0:
        return 0.0
    if time <= ground[first]:
        return ground[first + 1]
    for k in range(1, count):
        end = first + 2 * k
        if time < ground[end]:
            begin = end - 2
            part = (time - ground[begin]) / (ground[end] - ground[begin])
            return ground[begin + 1] + part * (ground[end + 1] - ground[begin + 1])
    return ground[first + 2 * count - 1]
