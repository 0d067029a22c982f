"""Forces at combined slip (E50 to E67)."""

import numpy as np

from magic_formula import lateral, longitudinal
from magic_formula.coefficients import complete
from magic_formula.curves import relative_load, weight
from magic_formula.lateral import lateral_peak, pure_lateral
from magic_formula.longitudinal import longitudinal_peak, pure_longitudinal


def longitudinal_weight(p, kappa, alpha, load, camber=0.0):
    """Gx alpha (-; E51)."""
    p = complete(p)
    dfz = relative_load(p, load)
    # E54; 1 / sqrt(1 + z^2) is cos(atan z)
    b = (p["RBX1"] + p["RBX3"] * camber**2) * p["LXAL"] / np.sqrt(1 + (p["RBX2"] * kappa) ** 2)
    e = np.minimum(p["REX1"] + p["REX2"] * dfz, 1.0)  # E56
    return weight(p, alpha, p["RHX1"], b, p["RCX1"], e)


def lateral_weight(p, kappa, alpha, load, camber=0.0):
    """Gy kappa (-; E59)."""
    p = complete(p)
    dfz = relative_load(p, load)
    stiffness = (p["RBY1"] + p["RBY4"] * camber**2) * p["LYKA"]
    b = stiffness / np.sqrt(1 + (p["RBY2"] * (alpha - p["RBY3"])) ** 2)  # E62
    e = np.minimum(p["REY1"] + p["REY2"] * dfz, 1.0)  # E64
    shift = p["RHY1"] + p["RHY2"] * dfz  # E65
    return weight(p, kappa, shift, b, p["RCY1"], e)


def ply_steer(p, kappa, alpha, load, camber=0.0, dp=0.0):
    """SVy kappa, the lateral force induced by longitudinal slip (N; E66, E67)."""
    p = complete(p)
    dfz = relative_load(p, load)
    reach = p["RVY1"] + p["RVY2"] * dfz + p["RVY3"] * p["LGAY"] * camber
    reach = lateral_peak(p, load, camber, dp) * reach
    reach = reach / np.sqrt(1 + (p["RVY4"] * alpha) ** 2) * p["LVYKA"]
    return reach * np.sin(p["RVY5"] * np.arctan(p["RVY6"] * kappa))


def combined(p, kappa, alpha, load, camber=0.0, dp=0.0):
    """Longitudinal and lateral force (N) at both slips (E50, E58)."""
    p = complete(p)
    fx = pure_longitudinal(p, kappa, load, camber, dp)
    fy = pure_lateral(p, alpha, load, camber, dp)
    fx = fx * longitudinal_weight(p, kappa, alpha, load, camber)
    fy = fy * lateral_weight(p, kappa, alpha, load, camber)
    return fx, fy + ply_steer(p, kappa, alpha, load, camber, dp)


def limits(p, kappa, alpha, load, dp=0.0):
    """What the components of the force cannot exceed at a load, without inclination (N).

    Peak and vertical shift of pure slip, by the largest weight there is, where the other slip makes
    up for the shift; across, also the peak of the force that slip ratio induces.
    """
    p = complete(p)
    dfz = relative_load(p, load)
    ahead = np.abs(longitudinal_peak(p, load, 0.0, dp)) + np.abs(
        longitudinal.vertical_shift(p, load)
    )
    ahead = ahead * longitudinal_weight(p, kappa, -p["RHX1"], load)
    across = np.abs(lateral_peak(p, load, 0.0, dp)) + np.abs(lateral.vertical_shift(p, load))
    across = across * lateral_weight(p, -p["RHY1"] - p["RHY2"] * dfz, alpha, load)
    induced = lateral_peak(p, load, 0.0, dp) * (p["RVY1"] + p["RVY2"] * dfz) * p["LVYKA"]
    return ahead, across + np.abs(induced)
