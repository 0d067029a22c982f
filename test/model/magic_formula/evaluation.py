"""Everything that a tire does, on the left or the right side of the vehicle."""

from typing import NamedTuple

import numpy as np

from magic_formula.combined import combined
from magic_formula.moments import aligning_moment, overturning_moment, rolling_resistance_moment
from magic_formula.radii import loaded_radius, spin_and_effective_radius


class Forces(NamedTuple):
    """N, N m and m, in arrays."""

    longitudinal_force: np.ndarray
    lateral_force: np.ndarray
    overturning_moment: np.ndarray
    rolling_resistance_moment: np.ndarray
    aligning_moment: np.ndarray
    loaded_radius: np.ndarray
    effective_rolling_radius: np.ndarray


def evaluate(p, load, kappa, alpha, camber=0.0, pressure=None, speed=16.7, mirrored=False):
    """Forces at a load (N) above 0, slip ratio, slip angle and inclination (rad), speed (m/s).

    pressure: Pa, of 6.1 and 6.2 alone; nominal if None. mirrored: the wheel is on the side that
    the file was not made for. 5.2 has no loaded radius; no file has one without its data.
    """
    given = (load, kappa, alpha, camber, speed, mirrored)
    load, kappa, alpha, camber, speed, mirrored = np.broadcast_arrays(*np.atleast_1d(*given))
    hand = np.where(mirrored, -1.0, 1.0)
    alpha, camber = hand * alpha, hand * camber
    dp = 0.0 if pressure is None else np.asarray(pressure) / p["NOMPRES"] - 1.0
    fx, fy = combined(p, kappa, alpha, load, camber, dp)
    spin, effective = spin_and_effective_radius(p, load, kappa, dp, speed)
    loaded = np.full(load.shape, np.nan)
    has_radius = p["UNLOADED_RADIUS"] > 0 and p["VERTICAL_STIFFNESS"] > 0
    if not (has_radius and (p["DREFF"] or p["FREFF"])):
        effective = loaded
    if has_radius and p.version != "5.2":
        loaded = loaded_radius(p, load, fx, fy, camber, dp, spin)
    mx = overturning_moment(p, load, fy, camber, dp)
    my = rolling_resistance_moment(p, load, fx, camber, dp, speed)
    mz = aligning_moment(p, kappa, alpha, load, fx, fy, camber, dp)
    return Forces(fx, hand * fy, hand * mx, my, hand * mz, loaded, effective)


def slopes(p, load, dp=0.0):
    """Slopes of Fx and Fy at no slip, shifts included (N, N/rad), by differences."""
    step = 1e-6
    either = [combined(p, way, 0.0, load, 0.0, dp)[0] for way in (-step, step)]
    aside = [combined(p, 0.0, way, load, 0.0, dp)[1] for way in (-step, step)]
    return (either[1] - either[0]) / (2 * step), (aside[1] - aside[0]) / (2 * step)
