"""Overturning moment (E69), rolling resistance moment (E70) and aligning moment (E31 to E78)."""

import numpy as np

from magic_formula.combined import lateral_weight
from magic_formula.curves import relative_load, stiffness_factor, wave
from magic_formula.lateral import (
    cornering_stiffness,
    horizontal_shift,
    lateral_peak,
    pure_lateral,
    vertical_shift,
)
from magic_formula.longitudinal import longitudinal_stiffness


def overturning_moment(p, load, fy, camber, dp):
    """Mx (N m; E69)."""
    g, f, fz = camber, fy / p["FNOMIN"], load / p["FNOMIN"]
    decay = np.cos(p["QSX5"] * np.arctan((p["QSX6"] * fz) ** 2))
    by_load = p["QSX1"] * p["LVMX"] - p["QSX2"] * g * (1 + p["PPMX1"] * dp) + p["QSX3"] * f
    by_load += p["QSX4"] * decay * np.sin(p["QSX7"] * g + p["QSX8"] * np.arctan(p["QSX9"] * f))
    by_load += p["QSX10"] * np.arctan(p["QSX11"] * fz) * g
    by_load -= p["QSX12"] * g * np.abs(g)  # 6.2
    by_side = p["QSX13"] + p["QSX14"] * np.abs(g)  # 6.2
    return p["UNLOADED_RADIUS"] * p["LMX"] * (load * by_load + fy * by_side)


def rolling_resistance_moment(p, load, fx, camber, dp, speed):
    """My (N m; E70), below 0 for a tire that rolls forward."""
    v, f, fz = speed / p["LONGVL"], fx / p["FNOMIN"], load / p["FNOMIN"]
    share = p["QSY1"] + p["QSY2"] * f + p["QSY3"] * np.abs(v) + p["QSY4"] * v**4
    lever = -p["UNLOADED_RADIUS"] * p["LMY"]
    if p.version == "5.2":
        return lever * load * share
    share = share + (p["QSY5"] + p["QSY6"] * fz) * camber**2
    return lever * p["FNOMIN"] * share * fz ** p["QSY7"] * (1 + dp) ** p["QSY8"]


def equivalent_slip(slip, kappa, stiffness_ratio):
    """The slip angle that stands for both slips (rad; E77, E78)."""
    return np.sign(slip) * np.arctan(np.sqrt(np.tan(slip) ** 2 + (stiffness_ratio * kappa) ** 2))


def trail(p, slip, shifted, alpha, load, camber, dp):
    """t (m; E73): a cosine of the equivalent slip, with the E of the shifted slip angle alone."""
    dfz, g = relative_load(p, load), p["LGAZ"] * camber
    scale = p["LKY"] / p["LMUY"]
    b = (p["QBZ1"] + p["QBZ2"] * dfz + p["QBZ3"] * dfz**2) * scale  # E40
    b = b * (1 + p["QBZ4"] * g + p["QBZ5"] * np.abs(g))
    c = p["QCZ1"]  # E41
    d = load * p["UNLOADED_RADIUS"] / (p["LFZO"] * p["FNOMIN"]) * (p["QDZ1"] + p["QDZ2"] * dfz)
    d = d * (1 - p["PPZ1"] * dp) * (1 + p["QDZ3"] * g + p["QDZ4"] * g**2) * p["LTR"]  # E42, E43
    bend = 1 + (p["QEZ4"] + p["QEZ5"] * g) * 2 / np.pi * np.arctan(b * c * shifted)
    e = np.minimum((p["QEZ1"] + p["QEZ2"] * dfz + p["QEZ3"] * dfz**2) * bend, 1.0)  # E44
    return d * wave(slip, b, c, e) * np.cos(alpha) * p["LFZO"]


def residual_moment(p, slip, alpha, load, camber, dp):
    """Mzr (N m; E75)."""
    dfz, g = relative_load(p, load), p["LGAZ"] * camber
    cy, dy = p["PCY1"] * p["LCY"], lateral_peak(p, load, camber, dp)
    by = stiffness_factor(cornering_stiffness(p, load, camber, dp), cy, dy)
    b = p["QBZ9"] * p["LKY"] / p["LMUY"] + p["QBZ10"] * by * cy  # E45
    plain = (p["QDZ6"] + p["QDZ7"] * dfz) * p["LRES"]
    inclined = (p["QDZ8"] + p["QDZ9"] * dfz) * (1 + p["PPZ2"] * dp)
    inclined = inclined + (p["QDZ10"] + p["QDZ11"] * dfz) * np.abs(g)
    d = load * p["UNLOADED_RADIUS"] * (plain + inclined * g * p["LKZC"]) * p["LMUY"]  # E47
    return d * np.cos(alpha) * np.cos(np.arctan(b * slip))


def aligning_moment(p, kappa, alpha, load, fx, fy, camber, dp):
    """Mz (N m; E71)."""
    dfz, g = relative_load(p, load), p["LGAZ"] * camber
    ky = cornering_stiffness(p, load, camber, dp)
    ratio = longitudinal_stiffness(p, load, dp) / ky
    trail_shift = p["QHZ1"] + p["QHZ2"] * dfz + (p["QHZ3"] + p["QHZ4"] * dfz) * g  # E35
    at = alpha + trail_shift  # E34
    lateral_shift = horizontal_shift(p, load, camber, dp)
    ar = alpha + lateral_shift + vertical_shift(p, load, camber) / ky  # E37, E38
    t = trail(p, equivalent_slip(at, kappa, ratio), at, alpha, load, camber, dp)
    residual = residual_moment(p, equivalent_slip(ar, kappa, ratio), alpha, load, camber, dp)
    # 5.2 and later versions differ in whether the force behind the trail sees the inclination
    inclined = camber if p.version == "5.2" else 0.0
    force = pure_lateral(p, alpha, load, inclined, dp)
    force = force * lateral_weight(p, kappa, alpha, load, camber)  # E74
    arm = p["SSZ1"] + p["SSZ2"] * fy / p["FNOMIN"] + (p["SSZ3"] + p["SSZ4"] * dfz) * g
    arm = p["UNLOADED_RADIUS"] * arm * p["LS"]  # E76
    return -t * force + residual + arm * fx
