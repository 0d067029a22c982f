"""What all curves share."""

import numpy as np


def relative_load(p, load):
    """df (-): load above the nominal one, relative to it (E1, E2)."""
    nominal = p["LFZO"] * p["FNOMIN"]
    return load / nominal - 1.0


def magic(slip, slope, c, d, e):
    """The curve through zero with that slope there; nothing where the peak is nothing."""
    b = stiffness_factor(slope, c, d)
    return d * np.sin(c * np.arctan(b * slip - e * (b * slip - np.arctan(b * slip))))


def stiffness_factor(slope, c, d):
    return np.divide(slope, c * d, out=np.zeros(np.broadcast(slope, d).shape), where=c * d != 0)


def wave(slip, b, c, e):
    """The cosine of the same curve."""
    return np.cos(c * np.arctan(b * slip - e * (b * slip - np.arctan(b * slip))))


def weight(p, slip, shift, b, c, e):
    """G: what combined slip leaves of a force, 1 where there is no other slip."""
    return np.maximum(wave(slip + shift, b, c, e) / wave(shift, b, c, e), p.lowest_weight)


def friction(at_nominal, slope, dfz):
    """Friction coefficient, of either sign, not beyond 0 where the load is far out of range."""
    return np.sign(at_nominal) * np.maximum(np.sign(at_nominal) * (at_nominal + slope * dfz), 0.0)
