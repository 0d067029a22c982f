"""Axes of the plane of the road under a wheel, in frame 2."""

from vehicle_roll_sim.model.compiled.jit import term


@term
def normal_of(i, terms):
    """The normal of the road at wheel i in frame 2."""
    return terms.normal_x[i], terms.normal_y[i], terms.normal_z[i]


@term
def in_plane(i, x, y, z, terms):
    """Components of a vector of frame 2 along the axes of the plane of the road at wheel i.

    Forward along the plane in the direction of the x axis, to the left in the plane, and along the
    normal.
    """
    a, b = terms.along[i], terms.across[i]
    nx, ny, nz = normal_of(i, terms)
    level = terms.level[i]
    ahead = level * (x + a * z)
    left = level * nz * ((1.0 + a * a) * y + b * z - a * b * x)
    return ahead, left, nx * x + ny * y + nz * z


@term
def from_plane(i, ahead, left, up, terms):
    """The vector in frame 2 from its components of `in_plane`."""
    a, b = terms.along[i], terms.across[i]
    nx, ny, nz = normal_of(i, terms)
    level = terms.level[i]
    aside = left * level * nz
    x = ahead * level - aside * a * b + up * nx
    return x, aside * (1.0 + a * a) + up * ny, a * ahead * level + aside * b + up * nz
