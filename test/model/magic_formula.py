"""The Magic Formula 5.2 once more, in numpy, from the book's list of equations: an oracle.

Every function takes slips and load in arrays and `p`, the coefficients of the file by name, with
all scaling factors and shifts; inclination and turn slip are zero. Angles are measured on the side
that the file was made for.
"""

import numpy as np


def relative_load(p, load):
    nominal = p["LFZO"] * p["FNOMIN"]
    return load / nominal - 1.0


def magic(slip, slope, c, d, e):
    """The curve through zero with that slope there; nothing where the peak is nothing."""
    b = np.divide(slope, c * d, out=np.zeros(np.broadcast(slope, d).shape), where=c * d != 0)
    return d * np.sin(c * np.arctan(b * slip - e * (b * slip - np.arctan(b * slip))))


def longitudinal_stiffness(p, load):
    """Kx, the slope of the longitudinal force at zero slip (N)."""
    dfz = relative_load(p, load)
    return load * (p["PKX1"] + p["PKX2"] * dfz) * np.exp(p["PKX3"] * dfz) * p["LKX"]


def cornering_stiffness(p, load):
    """Ky, the slope of the lateral force at zero slip (N/rad)."""
    nominal = p["LFZO"] * p["FNOMIN"]
    return p["PKY1"] * nominal * np.sin(2 * np.arctan(load / p["PKY2"] / nominal)) * p["LKY"]


def friction(at_nominal, slope, dfz):
    """Friction coefficient, of either sign, not beyond 0 where the load is far out of range."""
    return np.sign(at_nominal) * np.maximum(np.sign(at_nominal) * (at_nominal + slope * dfz), 0.0)


def longitudinal_peak(p, load):
    """Dx (N)."""
    return friction(p["PDX1"], p["PDX2"], relative_load(p, load)) * p["LMUX"] * load


def lateral_peak(p, load):
    """Dy (N)."""
    return friction(p["PDY1"], p["PDY2"], relative_load(p, load)) * p["LMUY"] * load


def pure_longitudinal(p, kappa, load):
    dfz = relative_load(p, load)
    slip = kappa + p["LHX"] * (p["PHX1"] + p["PHX2"] * dfz)
    vertical = p["LVX"] * p["LMUX"] * load * (p["PVX1"] + p["PVX2"] * dfz)
    c, d = p["PCX1"] * p["LCX"], longitudinal_peak(p, load)
    e = (p["PEX1"] + p["PEX2"] * dfz + p["PEX3"] * dfz**2) * (1 - p["PEX4"] * np.sign(slip))
    slope = longitudinal_stiffness(p, load)
    return magic(slip, slope, c, d, np.minimum(e * p["LEX"], 1.0)) + vertical


def pure_lateral(p, alpha, load):
    dfz = relative_load(p, load)
    slip = alpha + p["LHY"] * (p["PHY1"] + p["PHY2"] * dfz)
    vertical = p["LVY"] * p["LMUY"] * load * (p["PVY1"] + p["PVY2"] * dfz)
    c, d = p["PCY1"] * p["LCY"], lateral_peak(p, load)
    e = (p["PEY1"] + p["PEY2"] * dfz) * (1 - p["PEY3"] * np.sign(slip))
    slope = cornering_stiffness(p, load)
    return magic(slip, slope, c, d, np.minimum(e * p["LEY"], 1.0)) + vertical


def weight(slip, shift, b, c, e):
    """A ratio of cosines, which may not become negative."""

    def wave(s):
        return np.cos(c * np.arctan(b * s - e * (b * s - np.arctan(b * s))))

    return np.maximum(wave(slip + shift) / wave(shift), 0.0)


def combined(p, kappa, alpha, load):
    """Longitudinal and lateral force (N) at both slips."""
    dfz = relative_load(p, load)
    bx = p["RBX1"] * p["LXAL"] / np.sqrt(1 + (p["RBX2"] * kappa) ** 2)  # cos(atan z)
    ex = np.minimum(p["REX1"] + p["REX2"] * dfz, 1.0)
    fx = pure_longitudinal(p, kappa, load) * weight(alpha, p["RHX1"], bx, p["RCX1"], ex)
    by = p["RBY1"] * p["LYKA"] / np.sqrt(1 + (p["RBY2"] * (alpha - p["RBY3"])) ** 2)
    ey = np.minimum(p["REY1"] + p["REY2"] * dfz, 1.0)
    shift = p["RHY1"] + p["RHY2"] * dfz
    fy = pure_lateral(p, alpha, load) * weight(kappa, shift, by, p["RCY1"], ey)
    reach = lateral_peak(p, load) * (p["RVY1"] + p["RVY2"] * dfz)
    reach = reach / np.sqrt(1 + (p["RVY4"] * alpha) ** 2) * p["LVYKA"]
    return fx, fy + reach * np.sin(p["RVY5"] * np.arctan(p["RVY6"] * kappa))
