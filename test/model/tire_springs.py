"""The tires as springs, F = k x + k p x^2, of all wheels: arrays of shape (4,), SI units."""

import numpy as np


def parts(vehicle) -> tuple[np.ndarray, np.ndarray]:
    """k (N/m) and k p (N/m^2)."""
    stiffness = vehicle.per_wheel("tire_stiffness")
    return stiffness, stiffness * vehicle.per_wheel("tire_progression")


def tire_loads(vehicle, compression) -> np.ndarray:
    """Force (N) at compressions of at least 0 (m)."""
    linear, square = parts(vehicle)
    return linear * compression + square * compression**2


def tire_energies(vehicle, compression) -> np.ndarray:
    """The work of that force (J)."""
    linear, square = parts(vehicle)
    return linear * compression**2 / 2 + square * compression**3 / 3


def tire_compressions(vehicle, loads) -> np.ndarray:
    """Compressions (m) under loads (N), as roots of the polynomial."""
    wheels = zip(*parts(vehicle), loads, strict=True)
    roots = (np.roots([square, linear, -load]) for linear, square, load in wheels)
    return np.array([root.real.max() for root in roots])


def tire_slopes(vehicle, compression) -> np.ndarray:
    """dF/dx (N/m)."""
    linear, square = parts(vehicle)
    return linear + 2 * square * compression
