"""The plane that stands for the road under a wheel, edges included."""

from vehicle_roll_sim.model.compiled.jit import kernel, square_root, term
from vehicle_roll_sim.model.road.surface import surface

STEEPEST = 3.0
"""Largest slope of a plane (72 degrees)."""
GENTLE, STEEP = 0.2, 0.6
"""Slopes from which on edges are looked for, and from which on they count in full."""
CLEAR = 0.01
"""m: an edge counts in full if the wheel is closer to the plane by this."""


@term
def limited(along, across):
    """A slope of at most STEEPEST."""
    slope = square_root(along * along + across * across)
    share = STEEPEST / slope if slope > STEEPEST else 1.0
    return share * along, share * across


@term
def distance_to(height, along, across, z):
    """Distance of a wheel centre at the height z from a plane (m)."""
    return (z - height) / square_root(1.0 + along * along + across * across)


@kernel
def plane_under(place, radius, ground):
    """Height below the wheel centre (m), slopes along x and y, and friction of the plane.

    It touches the road vertically below the wheel centre. Where the road falls away behind an edge,
    such a plane would cut off the edge, and lift a wheel that rolls over it: if the road is steep
    and the plane through the foot of the perpendicular is further away from the wheel, that plane
    counts instead, with a smooth transition. On a road that is plane both are the same.
    """
    x, y, z = place
    height, along, across, friction = surface(x, y, ground)
    along, across = limited(along, across)
    square = along * along + across * across
    if square <= GENTLE * GENTLE:
        return height, along, across, friction
    near = distance_to(height, along, across, z)
    reach = min(max(near, 0.0), radius) / square_root(1.0 + square)
    ahead, aside = reach * along, reach * across
    foot, foot_along, foot_across, _ = surface(x + ahead, y + aside, ground)
    foot_along, foot_across = limited(foot_along, foot_across)
    foot -= foot_along * ahead + foot_across * aside
    beyond = distance_to(foot, foot_along, foot_across, z) - near
    if beyond <= 0.0:
        return height, along, across, friction
    share = min((square_root(square) - GENTLE) / (STEEP - GENTLE), 1.0) * min(beyond / CLEAR, 1.0)
    height += share * (foot - height)
    along += share * (foot_along - along)
    return height, along, across + share * (foot_across - across), friction
