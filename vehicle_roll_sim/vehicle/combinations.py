"""Values that are plausible by themselves, but not together; complements `plausibility`."""

import math
from collections.abc import Iterator

from vehicle_roll_sim.vehicle.derived_values import AXLES, GRAVITY
from vehicle_roll_sim.vehicle.figures import VehicleFigures, figures_of
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire_file import Tire

STATIC_STABILITY = (0.5, 4.0)
"""From loaded trucks with high loads to race cars; passenger cars have 1.2 to 1.5."""
LARGEST_ROLL_GRADIENT = 12.0
"""deg/g; soft passenger cars have 7."""
FRONT_SHARE = (0.25, 0.9)
"""Of the roll stiffness."""
FRONT_LOAD = (0.25, 0.75)
"""Share of the weight on the front axle."""
RADIUS_OF_TIRE = (0.95, 1.05)
"""Radius in the vehicle file over UNLOADED_RADIUS, if the tire file gives the rolling radius."""
LOAD_OF_TIRE = (0.25, 2.0)
"""Static load of a tire over the nominal load of its file, LFZO FNOMIN."""


def combinations(vehicle: Vehicle) -> list[str]:
    """One line for each implausible combination, beginning with a parameter's name."""
    figures = figures_of(vehicle)
    return [*_rolling(vehicle, figures), *_balance(vehicle, figures), *_tires(vehicle, figures)]


def _rolling(vehicle: Vehicle, figures: VehicleFigures) -> Iterator[str]:
    least, most = STATIC_STABILITY
    if not least <= figures.static_stability_factor <= most:
        found = f"{vehicle.cg_height:g} m with tracks of {vehicle.front_track:g} and "
        found += f"{vehicle.rear_track:g} m gives a static stability factor of "
        found += f"{figures.static_stability_factor:.3g}"
        yield f"cg_height: {found}: typically {least:g} to {most:g}"
    softest = min(AXLES, key=lambda axle: figures.axles[axle].roll_stiffness)
    name = f"{softest}_spring_stiffness"
    stiffness = f"a roll stiffness of {figures.roll_stiffness:.4g} N m/rad in all"
    if math.isinf(figures.roll_gradient):
        least = vehicle.sprung_mass * GRAVITY * figures.roll_axis_depth
        needs = f"it must be more than {least:.4g}, or the sprung mass topples over its roll axis"
        yield f"{name}: {stiffness}: {needs}"
    elif (gradient := math.degrees(figures.roll_gradient) * GRAVITY) > LARGEST_ROLL_GRADIENT:
        found = f"{stiffness} gives a roll gradient of {gradient:.3g} deg/g"
        yield f"{name}: {found}: typically at most {LARGEST_ROLL_GRADIENT:g}"


def _balance(vehicle: Vehicle, figures: VehicleFigures) -> Iterator[str]:
    least, most = FRONT_SHARE
    if not least <= figures.front_share <= most:
        found = f"the front axle has {figures.front_share:.3g} of the roll stiffness"
        yield f"front_spring_stiffness: {found}: typically {least:g} to {most:g}"
    least, most = FRONT_LOAD
    share = 1 - figures.cg_to_front_axle / figures.wheelbase
    if not least <= share <= most:
        found = f"{vehicle.cg_to_front_axle:g} m puts {share:.3g} of the weight on the front axle"
        yield f"cg_to_front_axle: {found}: typically {least:g} to {most:g}"


def _tires(vehicle: Vehicle, figures: VehicleFigures) -> Iterator[str]:
    least, most = LOAD_OF_TIRE
    for axle, tire in vehicle.axle_tires.items():
        load = figures.axles[axle].wheel_load
        nominal = tire.coefficients["FNOMIN"] * tire.coefficients["LFZO"]
        if not least <= load / nominal <= most:
            found = (
                f"its static load of {load:.4g} N is {load / nominal:.3g} times its nominal load"
            )
            name = "tire" if vehicle.tire is not None else f"{axle}_tire"
            yield f"{name}: {found}, {nominal:g} N, at the {axle}: typically {least:g} to {most:g}"
        yield from _radius(vehicle, axle, tire)


def _radius(vehicle: Vehicle, axle: str, tire: Tire) -> Iterator[str]:
    radius = float(vehicle.per_wheel("tire_radius")[AXLES[axle]])
    own, (least, most) = tire.coefficients["UNLOADED_RADIUS"], RADIUS_OF_TIRE
    if tire.record()["rolls_on_own_radius"] and not least <= radius / own <= most:
        name = f"{axle}_tire_radius"
        name = name if name in vehicle.given else "tire_radius"
        found = f"{radius:g} m, but slip of the {axle} wheels uses that of the tire file, "
        yield f"{name}: {found}UNLOADED_RADIUS {own:g} m: typically {least:g} to {most:g} of it"
