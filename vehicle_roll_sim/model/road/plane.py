"""The plane that stands for the road under a wheel, edges included."""

from vehicle_roll_sim.model.compiled.jit import kernel, square_root, term
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.road.surface import surface, surface_under_wheels

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
def planes_under_wheels(vehicle, ground, terms):
    """Height below every wheel centre (m), slopes along x and y, and friction of its plane.

    The plane touches the road vertically below the wheel centre. Where the road drops behind an
    edge, such a plane would cut off the edge and lift a wheel that rolls over it. If the road is
    steep and the plane through the foot of the perpendicular is further from the wheel, that plane
    is therefore used instead, with a smooth transition. On a plane road both are the same.
    """
    surface_under_wheels(ground, terms)
    for i in range(WHEEL_COUNT):
        along, across = terms.slope_x[i], terms.slope_y[i]
        if along * along + across * across > GENTLE * GENTLE:
            along, across = limited(along, across)
            place = (terms.place_x[i], terms.place_y[i], terms.place_z[i])
            plane = (terms.height[i], along, across)
            height, along, across = plane_on_steep_road(
                plane, place, vehicle.tire_radius[i], ground
            )
            terms.height[i], terms.slope_x[i], terms.slope_y[i] = height, along, across


@kernel
def plane_on_steep_road(plane, place, radius, ground):
    """The plane that stands for a steep road: its height below the wheel centre, and slopes.

    plane: that which touches the road there. place: of the wheel centre.
    """
    (height, along, across), (x, y, z) = plane, place
    square = along * along + across * across
    near = distance_to(height, along, across, z)
    reach = min(max(near, 0.0), radius) / square_root(1.0 + square)
    ahead, aside = reach * along, reach * across
    foot, foot_along, foot_across, _ = surface(x + ahead, y + aside, ground)
    foot_along, foot_across = limited(foot_along, foot_across)
    foot -= foot_along * ahead + foot_across * aside
    beyond = distance_to(foot, foot_along, foot_across, z) - near
    if beyond <= 0.0:
        return height, along, across
    share = min((square_root(square) - GENTLE) / (STEEP - GENTLE), 1.0) * min(beyond / CLEAR, 1.0)
    height += share * (foot - height)
    along += share * (foot_along - along)
    return height, along, across + share * (foot_across - across)
