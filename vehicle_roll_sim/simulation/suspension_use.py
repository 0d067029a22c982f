"""Which details of a vehicle a model uses; those that it cannot use are refused."""

import numpy as np

from vehicle_roll_sim.declaration import ON, InputError
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.air_parameters import OF_SIDE_AND_LIFT
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.suspension_details import has_any
from vehicle_roll_sim.vehicle.suspension_parameters import (
    AXLES,
    COMPLIANCE_CAMBER,
    MOTION_RATIOS,
    OF_COMPLIANCE,
    OF_STEERING,
    OF_STRUTS,
)

TOE_CHANGE = "toe_change"
GUIDANCE = ("half_track_change", "longitudinal_change", "camber_change", "carrier_pitch_change")
"""Parameters of an axle that only model 2 uses."""
OF_STRUTS_ALONE = tuple(name for name in OF_STRUTS if name not in MOTION_RATIOS)
OF_WHEEL_TRAVEL = (*OF_STRUTS_ALONE, *OF_COMPLIANCE, "roll_steer", TOE_CHANGE)
"""Parameters of an axle that models without wheel travel, or without struts, do not use."""


def check_details_are_used(vehicle: Vehicle, options: Options) -> None:
    """Raise InputError for the first detail that the model does not use.

    options: with `on` or `off` in place of `auto`.
    """
    for name in OF_SIDE_AND_LIFT if options.has_eight_dof else ():
        _refuse(vehicle, name, f"a 14 DOF model; {options.model} has no such aerodynamic force")
    for axle in AXLES:
        for name in () if options.is_kinematic else GUIDANCE:
            _refuse(vehicle, f"{axle}_{name}", "model 2, whose wheels are guided")
        for name in OF_WHEEL_TRAVEL if options.has_eight_dof else ():
            _refuse(vehicle, f"{axle}_{name}", f"a 14 DOF model; {options.model} has none of it")
        for name in MOTION_RATIOS if options.has_eight_dof else ():
            if isinstance(getattr(vehicle, f"{axle}_{name}"), tuple):
                _refuse(vehicle, f"{axle}_{name}", f"a 14 DOF model; {options.model} has numbers")
        if options.tire_moments != ON:
            _refuse(vehicle, f"{axle}_aligning_moment_steer", "tire_moments on")


def _check_tires_incline(vehicle: Vehicle, tires: np.ndarray) -> None:
    """Raise InputError for compliance camber if nothing depends on the inclination of the wheel."""
    for axle, tire in zip(AXLES, tires, strict=True):
        if tire["plain"]:
            needed = "a tire that depends on inclination, or tire_moments on and a tire with them"
            _refuse(vehicle, f"{axle}_{COMPLIANCE_CAMBER}", needed)


def _refuse(vehicle: Vehicle, name: str, needed: str) -> None:
    if name in vehicle.given:
        place, allowed = vehicle.stated_at.get(name, name), f"no value, since it needs {needed}"
        raise InputError(place, vehicle.given[name], allowed)


def steers_each_wheel(vehicle: Vehicle, options: Options) -> bool:
    """Whether the wheels of an axle may have different steering angles.

    In model 2 a change of toe with travel is one of the wheel carriers, not of the steering.
    """
    names = OF_STEERING if options.is_kinematic else (*OF_STEERING, TOE_CHANGE)
    return has_any(vehicle, names) or bool(vehicle.ackermann_percentage)


def use_details(record: np.ndarray, tires: np.ndarray, vehicle: Vehicle, options: Options) -> None:
    """Check the details of a vehicle, and set what depends on the model in its VEHICLE record.

    tires: TIRE records of front and rear axle.
    """
    check_details_are_used(vehicle, options)
    _check_tires_incline(vehicle, tires)
    record["details"]["steering"] = steers_each_wheel(vehicle, options)
