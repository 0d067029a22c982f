"""Spin, effective rolling radius and loaded radius."""

import numpy as np

SETTLED = 60
"""Steps after which the spin, which changes Re by its growth alone, is known to rounding."""
GRID = 200
"""Steps from the free radius to 0, in the first of which that carries the load it is sought."""


def free_radius(p, spin):
    """R_omega (m): the unloaded radius of the spinning tire; in 5.2 it does not grow."""
    if p.version == "5.2":
        return p["UNLOADED_RADIUS"]
    growth = p["Q_V1"] * (spin * p["UNLOADED_RADIUS"] / p["LONGVL"]) ** 2
    return p["UNLOADED_RADIUS"] * (p["Q_RE0"] + growth)


def effective_radius(p, load, dp, spin):
    """Re (m)."""
    stiffness = p["VERTICAL_STIFFNESS"] * (1 + p["PFZ1"] * dp)
    fz = load / p["FNOMIN"]
    arc = p["DREFF"] * np.arctan(p["BREFF"] * fz) + p["FREFF"] * fz
    return free_radius(p, spin) - p["FNOMIN"] / stiffness * arc


def spin_and_effective_radius(p, load, kappa, dp, speed):
    """omega (rad/s) and Re (m), of which (1 + kappa) speed is the product."""
    spin = (1 + kappa) * speed / p["UNLOADED_RADIUS"]
    for _ in range(SETTLED):
        spin = (1 + kappa) * speed / effective_radius(p, load, dp, spin)
    return spin, effective_radius(p, load, dp, spin)


def load_at(p, radius, fx, fy, camber, dp, spin):
    """Fz (N) that deflects the tire to a loaded radius (m) while it makes those forces."""
    r0, nominal = p["UNLOADED_RADIUS"], p["FNOMIN"]
    free = free_radius(p, spin)
    deflection = np.maximum(free - radius, 0.0)
    side, exponent = 0.0, 0.0
    if p.version == "6.2":
        width = (1.075 - 0.5 * p["ASPECT_RATIO"]) * p["WIDTH"]
        bulge = p["Q_CAM1"] * radius + p["Q_CAM2"] * radius**2
        largest = p["Q_CAM1"] * free + p["Q_CAM2"] * free**2
        bulge = np.divide(bulge, largest, out=np.zeros_like(radius), where=largest != 0)
        lean = bulge**2 * width / 8 * np.abs(np.tan(camber))
        deflection = deflection + lean - p["Q_CAM3"] * deflection * np.abs(camber)
        deflection = np.maximum(deflection, 0.0)
        share = radius / free
        side = (p["Q_FYS1"] + p["Q_FYS2"] * share + p["Q_FYS3"] * share**2) * camber
        exponent = p["Q_FCY2"]
    relative = deflection / r0
    slope = np.sqrt((p["VERTICAL_STIFFNESS"] * r0 / nominal) ** 2 - 4 * p["Q_FZ2"])
    with np.errstate(divide="ignore", invalid="ignore"):
        sideways = relative**exponent * p["Q_FCY"] * (fy - side) / nominal
        softening = (p["Q_FCX"] * fx / nominal) ** 2 + sideways**2
        factor = 1 + p["Q_V2"] * r0 * np.abs(spin) / p["LONGVL"] - softening
        force = factor * (slope * relative + p["Q_FZ2"] * relative**2) * nominal
    return np.where(relative > 0, force * (1 + p["PFZ1"] * dp), 0.0)


def loaded_radius(p, load, fx, fy, camber, dp, spin):
    """Rl (m): the first radius, from the free one downwards, that carries the load."""
    free = free_radius(p, spin)
    radii = free * (1 - np.arange(GRID + 1.0)[:, None] / GRID)
    carry = load_at(p, radii, fx, fy, camber, dp, spin)[1:] >= load
    first, each = 1 + carry.argmax(axis=0), np.arange(radii.shape[1])
    below = np.where(carry.any(axis=0), radii[first, each], np.nan)
    above = np.where(carry.any(axis=0), radii[first - 1, each], radii[-1])
    for _ in range(SETTLED):
        middle = (above + below) / 2
        carries = load_at(p, middle, fx, fy, camber, dp, spin) >= load
        above, below = np.where(carries, above, middle), np.where(carries, middle, below)
    return (above + below) / 2
