"""Forces at combined slip (E50 to E67)."""

import numpy as np

from magic_formula.coefficients import complete
from magic_formula.curves import relative_load, weight
from magic_formula.lateral import lateral_peak, pure_lateral
from magic_formula.longitudinal import pure_longitudinal


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
    reach = p["RVY1"] + p["RVY2"] * dfz + p["RVY3"] * camber
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
