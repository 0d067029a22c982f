"""Checks of springs, dampers, stops and steering gear against each other."""

import itertools

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.records import STOPS
from vehicle_roll_sim.vehicle.steering_gear import check_gear
from vehicle_roll_sim.vehicle.suspension_details import force_and_slope, spring_of
from vehicle_roll_sim.vehicle.suspension_parameters import AXLES, MOTION_RATIOS
from vehicle_roll_sim.vehicle.travel_curves import TravelCurve

LOWEST_RATIO = 0.01


def check_suspension(vehicle) -> None:
    """Raise InputError for values that do not agree with each other."""
    if "steering_gear" in vehicle.given:
        check_gear("steering_gear", vehicle.given["steering_gear"])
    for axle in AXLES:
        for name in MOTION_RATIOS:
            _check_ratio(vehicle.given, f"{axle}_{name}")
        _check_spring(vehicle, f"{axle}_spring_force", axle)
        _check_wheel_rate(vehicle, f"{axle}_spring_motion_ratio", axle)
        _check_damper(vehicle.given, f"{axle}_damper_force", f"{axle}_rebound_damping")
        for stop in STOPS:
            _check_stop(vehicle.given, f"{axle}_{stop}")


def _steps(table: tuple) -> list[float]:
    return [after - before for (_, before), (_, after) in itertools.pairwise(table)]


def _check_ratio(given: dict, name: str) -> None:
    """A spring or damper is compressed as its wheel moves up, at all travels."""
    if name not in given:
        return
    ratio = given[name]
    if isinstance(ratio, tuple):
        if not min(_steps(ratio)) > 0.0:
            raise InputError(name, ratio, "compressions that rise from point to point")
        curve = TravelCurve(ratio)
        if not min(force_and_slope(curve, travel)[1] for travel, _ in ratio) > 0.0:
            allowed = "compressions that still rise at all points of the smooth curve through them"
            raise InputError(name, ratio, allowed)
    elif not ratio >= LOWEST_RATIO:
        raise InputError(name, ratio, f"at least {LOWEST_RATIO:g}")


def _check_spring(vehicle, name: str, axle: str) -> None:
    """A spring force rises with compression, beyond the last point too."""
    if name not in vehicle.given:
        return
    table = vehicle.given[name]
    if not min(_steps(table)) > 0.0:
        raise InputError(name, table, "forces that rise from point to point")
    spring = spring_of(vehicle, axle)
    for travel, _ in (table[0], table[-1]):
        if not force_and_slope(spring, travel)[1] > 0.0:
            allowed = "forces that still rise at both ends of the smooth curve through the points"
            raise InputError(name, table, allowed)


def _check_wheel_rate(vehicle, name: str, axle: str) -> None:
    """A spring resists the travel of its wheel at rest, though its motion ratio may fall."""
    rate = float(vehicle.stiffness_at_rest[AXLES[axle]])
    if name in vehicle.given and not rate > 0.0:
        allowed = f"a ratio that falls less: it makes the stiffness at the wheel {rate:.0f} N/m"
        raise InputError(name, vehicle.given[name], allowed)


def _check_damper(given: dict, name: str, rebound: str) -> None:
    """A damper resists: its force is 0 at 0, and does not fall with the velocity."""
    if name not in given:
        return
    table = given[name]
    if (0.0, 0.0) not in table:
        raise InputError(name, table, "a table with the point [0, 0]")
    if not min(_steps(table)) >= 0.0:
        raise InputError(name, table, "forces that do not fall from point to point")
    if rebound in given:
        allowed = f"no value together with {name}, which has both directions"
        raise InputError(rebound, given[rebound], allowed)


def _check_stop(given: dict, stop: str) -> None:
    """A stop is somewhere, and stiff."""
    forces = [name for name in (f"{stop}_stiffness", f"{stop}_progression") if name in given]
    clearance = f"{stop}_clearance"
    if forces and clearance not in given:
        raise InputError(clearance, None, f"required, since {forces[0]} is given")
    if clearance in given and not any(given[name] for name in forces):
        value = given.get(f"{stop}_stiffness")
        raise InputError(f"{stop}_stiffness", value, f"above 0, since {clearance} is given")
