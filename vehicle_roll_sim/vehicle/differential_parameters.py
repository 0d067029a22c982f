"""Parameters of the differentials, and how the equations take them."""

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.vehicle.suspension_parameters import AXLES

_DECLARED = {
    "damping": (
        "viscous coupling of the {axle} wheels: torque from the faster to the slower one per "
        "difference of their speeds; 0, the default, is an open differential, a large value a "
        "locked one",
        {"unit": "N m s/rad", "minimum": 0.0, "maximum": 1e5},
    ),
    "preload": (
        "makes the {axle} differential a limited-slip one: torque at which its coupling slips "
        "without drive torque; the damping is then the slope at equal speeds",
        {"unit": "N m", "minimum": 10.0, "maximum": 1e5},
    ),
    "locking": (
        "share of the torque of the {axle} axle by which the torques of its wheels may differ, "
        "beyond what the preload allows; by default 0",
        {"unit": "", "minimum": 0.0, "maximum": 1.0},
    ),
}


def of_differential(name: str, axle: str):
    """The declaration of a parameter of an axle's differential; it may be absent."""
    meaning, limits = _DECLARED[name]
    return parameter(meaning.format(axle=axle), **limits, default=None)


def check_differentials(vehicle) -> None:
    """Raise InputError for values of a limited-slip differential without those that they need."""
    for axle in AXLES:
        for name, needed in (("preload", "damping"), ("locking", "preload")):
            field, other = f"{axle}_differential_{name}", f"{axle}_differential_{needed}"
            if field in vehicle.given and not getattr(vehicle, other):
                raise InputError(field, vehicle.given[field], f"no value without a {other}")


def differentials_of(vehicle) -> dict[str, np.ndarray]:
    """Fields of a VEHICLE record, 0 for what is not given."""
    return {
        f"differential_{name}": np.repeat(
            [getattr(vehicle, f"{axle}_differential_{name}") or 0.0 for axle in AXLES], 2
        )
        for name in _DECLARED
    }
