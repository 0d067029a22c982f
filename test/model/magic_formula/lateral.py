"""Lateral force at pure slip (E19 to E30). dp: change of pressure, relative to nominal."""

import numpy as np

from magic_formula.coefficients import complete
from magic_formula.curves import friction, magic, relative_load


def cornering_stiffness(p, load, camber=0.0, dp=0.0):
    """Ky, the slope of the lateral force at zero slip (N/rad; E25)."""
    p = complete(p)
    g = p["LGAY"] * camber
    nominal = p["LFZO"] * p["FNOMIN"]
    at_peak = (p["PKY2"] + p["PKY5"] * g**2) * (1 + p["PPY2"] * dp)
    slope = p["PKY1"] * nominal * np.sin(p["PKY4"] * np.arctan(load / at_peak / nominal)) * p["LKY"]
    return slope * (1 + p["PPY1"] * dp) * (1 - p["PKY3"] * np.abs(g))


def lateral_peak(p, load, camber=0.0, dp=0.0):
    """Dy (N; E22, E23)."""
    p = complete(p)
    mu = friction(p["PDY1"], p["PDY2"], relative_load(p, load))
    mu = mu * (1 + p["PPY3"] * dp + p["PPY4"] * dp**2)
    mu = mu * (1 - p["PDY3"] * (p["LGAY"] * camber) ** 2)
    return mu * p["LMUY"] * load


def camber_thrust(p, load, camber):
    """SVy gamma, the part of the vertical shift that is due to inclination (N; E28)."""
    dfz = relative_load(p, load)
    slope = load * (p["PVY3"] + p["PVY4"] * dfz)
    return slope * p["LGAY"] * camber * p["LKYC"] * p["LMUY"]


def vertical_shift(p, load, camber=0.0):
    """SVy (N; E29)."""
    p = complete(p)
    dfz = relative_load(p, load)
    vertical = p["LVY"] * p["LMUY"] * load * (p["PVY1"] + p["PVY2"] * dfz)
    return vertical + camber_thrust(p, load, camber)


def horizontal_shift(p, load, camber=0.0, dp=0.0):
    """SHy (rad; E27)."""
    p = complete(p)
    dfz = relative_load(p, load)
    shift = p["LHY"] * (p["PHY1"] + p["PHY2"] * dfz)
    if p.version == "5.2":
        return shift + p["PHY3"] * p["LGAY"] * camber
    camber_stiffness = (
        load * (p["PKY6"] + p["PKY7"] * dfz) * (1 + p["PPY5"] * dp) * p["LKYC"]
    )  # E30
    thrust = camber_stiffness * camber - camber_thrust(p, load, camber)
    return shift + thrust / cornering_stiffness(p, load, camber, dp)


def pure_lateral(p, alpha, load, camber=0.0, dp=0.0):
    """Fy0 (N; E19)."""
    p = complete(p)
    g = p["LGAY"] * camber
    dfz = relative_load(p, load)
    slip = alpha + horizontal_shift(p, load, camber, dp)  # E20
    c = p["PCY1"] * p["LCY"]  # E21
    d = lateral_peak(p, load, camber, dp)
    bend = 1 + p["PEY5"] * g**2 - (p["PEY3"] + p["PEY4"] * g) * np.sign(slip)
    e = (p["PEY1"] + p["PEY2"] * dfz) * bend  # E24
    slope = cornering_stiffness(p, load, camber, dp)
    vertical = vertical_shift(p, load, camber)
    return magic(slip, slope, c, d, np.minimum(e * p["LEY"], 1.0)) + vertical
