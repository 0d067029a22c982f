"""A banked curve: a clothoid, an arc of constant radius, and a clothoid back to a straight road.

Its own numbers: index of the table, its points and their distance (m), length of a clothoid, length
of the arc (m), curvature of the arc (1/m, positive to the left), bank there (m/m, positive with the
outer side raised), half of the width of the road, and rounding (m). The table has x and y
of points on the centreline, from the beginning of the first clothoid on.
"""

from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.road.shapes import lift

STRIDE = 8
"""Every so many points of the table are checked first, then all those around the nearest."""
ITERATIONS = 4
"""Of Newton's method, for the foot of the perpendicular: exact to rounding."""
POINT = 2
"""Numbers of a point in the table."""
NODE, SIDE_WEIGHT, MIDDLE_WEIGHT = math.sqrt(0.6), 5.0 / 18.0, 8.0 / 18.0
"""Gauss-Legendre quadrature with three nodes."""


@term
def heading_along(s, transition, arc, curvature):
    """Heading of the centreline (rad): its curvature grows and falls linearly in the clothoids."""
    total = 2.0 * transition + arc
    s = min(max(s, 0.0), total)
    if s < transition:
        return 0.5 * curvature * s * s / transition
    if s <= transition + arc:
        return curvature * (s - 0.5 * transition)
    left = total - s
    return curvature * (transition + arc) - 0.5 * curvature * left * left / transition


@term
def curvature_along(s, transition, arc, curvature):
    """Curvature of the centreline (1/m)."""
    total = 2.0 * transition + arc
    if s <= 0.0 or s >= total:
        return 0.0
    if s < transition:
        return curvature * s / transition
    return curvature if s <= transition + arc else curvature * (total - s) / transition


@kernel
def advanced(x, y, s, distance, transition, arc, curvature):
    """The point of the centreline a distance (m) after that at s, which is at x, y."""
    for node, weight in ((-NODE, SIDE_WEIGHT), (0.0, MIDDLE_WEIGHT), (NODE, SIDE_WEIGHT)):
        angle = heading_along(s + 0.5 * distance * (1.0 + node), transition, arc, curvature)
        x += weight * distance * math.cos(angle)
        y += weight * distance * math.sin(angle)
    return x, y


@kernel
def nearest_point(x, y, first, count, ground):
    """Number of the point of the table that is nearest to x, y."""
    best, least = 0, math.inf
    for k in range(0, count, STRIDE):
        ahead, aside = x - ground[first + POINT * k], y - ground[first + POINT * k + 1]
        square = ahead * ahead + aside * aside
        if square < least:
            best, least = k, square
    middle = best
    for k in range(max(middle - STRIDE, 0), min(middle + STRIDE + 1, count)):
        ahead, aside = x - ground[first + POINT * k], y - ground[first + POINT * k + 1]
        square = ahead * ahead + aside * aside
        if square < least:
            best, least = k, square
    return best


@kernel
def on_centreline(x, y, at, ground):
    """Distance along the centreline, distance to its left (m), and heading there (rad)."""
    first, count, spacing = int(ground[at]), int(ground[at + 1]), ground[at + 2]
    transition, arc, curvature = ground[at + 3], ground[at + 4], ground[at + 5]
    k = nearest_point(x, y, first, count, ground)
    px, py = ground[first + POINT * k], ground[first + POINT * k + 1]
    start = spacing * k
    s, ahead, aside, angle = start, 0.0, 0.0, 0.0
    for _ in range(ITERATIONS):
        fx, fy = advanced(px, py, start, s - start, transition, arc, curvature)
        angle = heading_along(s, transition, arc, curvature)
        ahead, aside = x - fx, y - fy
        c, sine = math.cos(angle), math.sin(angle)
        left = c * aside - sine * ahead
        s += (c * ahead + sine * aside) / (
            1.0 - curvature_along(s, transition, arc, curvature) * left
        )
    return s, left, angle


@kernel
def banked_curve(x, y, at, ground):
    """Height, and slopes along x and y of the feature."""
    transition, arc, curvature = ground[at + 3], ground[at + 4], ground[at + 5]
    bank, half, rounding = ground[at + 6], ground[at + 7], ground[at + 8]
    s, n, angle = on_centreline(x, y, at, ground)
    rise, rise_slope = lift(s, 0.0, transition, rounding)
    fall, fall_slope = lift(s, transition + arc, transition, rounding)
    steep = -bank if curvature > 0.0 else bank
    slope, change = steep * (rise - fall), steep * (rise_slope - fall_slope)
    kept = min(max(n, -half), half)
    across = slope if kept == n else 0.0
    along = change * kept / (1.0 - curvature_along(s, transition, arc, curvature) * n)
    c, sine = math.cos(angle), math.sin(angle)
    return slope * kept, along * c - across * sine, along * sine + across * c
