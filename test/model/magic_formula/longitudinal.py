"""Longitudinal force at pure slip (E9 to E18). dp: change of pressure, relative to nominal."""

import numpy as np

from magic_formula.coefficients import complete
from magic_formula.curves import friction, magic, relative_load


def longitudinal_stiffness(p, load, dp=0.0):
    """Kx, the slope of the longitudinal force at zero slip (N; E15)."""
    p = complete(p)
    dfz = relative_load(p, load)
    pressure = 1 + p["PPX1"] * dp + p["PPX2"] * dp**2
    slope = load * (p["PKX1"] + p["PKX2"] * dfz) * np.exp(p["PKX3"] * dfz) * p["LKX"]
    return slope * pressure


def longitudinal_peak(p, load, camber=0.0, dp=0.0):
    """Dx (N; E12, E13)."""
    p = complete(p)
    mu = friction(p["PDX1"], p["PDX2"], relative_load(p, load))
    mu = mu * (1 + p["PPX3"] * dp + p["PPX4"] * dp**2)
    mu = mu * (1 - p["PDX3"] * (p["LGAX"] * camber) ** 2)
    return mu * p["LMUX"] * load


def horizontal_shift(p, load):
    """SHx (-; E17)."""
    p = complete(p)
    return p["LHX"] * (p["PHX1"] + p["PHX2"] * relative_load(p, load))


def vertical_shift(p, load):
    """SVx (N; E18)."""
    p = complete(p)
    dfz = relative_load(p, load)
    return p["LVX"] * p["LMUX"] * load * (p["PVX1"] + p["PVX2"] * dfz)


def pure_longitudinal(p, kappa, load, camber=0.0, dp=0.0):
    """Fx0 (N; E9)."""
    p = complete(p)
    dfz = relative_load(p, load)
    slip = kappa + horizontal_shift(p, load)  # E10
    c = p["PCX1"] * p["LCX"]  # E11
    d = longitudinal_peak(p, load, camber, dp)
    e = (p["PEX1"] + p["PEX2"] * dfz + p["PEX3"] * dfz**2) * (1 - p["PEX4"] * np.sign(slip))  # E14
    slope = longitudinal_stiffness(p, load, dp)
    return magic(slip, slope, c, d, np.minimum(e * p["LEX"], 1.0)) + vertical_shift(p, load)
