"""Consistency checks between the values of a vehicle."""

import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.model.integration.events import plausible_magnitudes
from vehicle_roll_sim.model.variants import MODELS
from vehicle_roll_sim.vehicle.actuator_parameters import check_actuators
from vehicle_roll_sim.vehicle.air_parameters import check_air
from vehicle_roll_sim.vehicle.axle_tires import of_file
from vehicle_roll_sim.vehicle.body_parameters import check_body
from vehicle_roll_sim.vehicle.chassis_parameters import ROLL_CENTRES
from vehicle_roll_sim.vehicle.derived_values import AXLES, BAR_SPELLINGS, DerivedValues
from vehicle_roll_sim.vehicle.differential_parameters import check_differentials
from vehicle_roll_sim.vehicle.masses import PRODUCTS, tensor
from vehicle_roll_sim.vehicle.sensor_parameters import check_sensors
from vehicle_roll_sim.vehicle.suspension_checks import check_suspension
from vehicle_roll_sim.vehicle.tire.moments import ROLLING_RESISTANCE, has_moment
from vehicle_roll_sim.vehicle.tire_file import Tire
from vehicle_roll_sim.vehicle.travel_curves import check_knots

MOMENT = {"roll_inertia": "roll", "pitch_inertia": "pitch", "yaw_inertia": "yaw"}
ROUNDING = 1e-9
LARGEST_TURN = 1.0
"""rad: of a wheel carrier, in a table over wheel travel."""
VERSION_WITHOUT_PRESSURE = "5.2"


def check_given(vehicle: DerivedValues, per_axle: dict[str, tuple[str, ...]]) -> None:
    """Raise InputError for values that must not be given together, and for wrong tires.

    per_axle: parameters for both axles, each with those of a single axle that may replace it.
    """
    _check_tires(vehicle)
    _check_given_once(vehicle, per_axle)
    _check_pressures(vehicle)
    _check_taken_from_tires(vehicle)


def check_consistency(vehicle: DerivedValues) -> None:
    """Raise InputError for values that are inconsistent with one another."""
    _check_roll_centres(vehicle)
    _check_inertias(vehicle)
    _check_offset(vehicle)
    _check_anti_roll_bars(vehicle)
    _check_carriers(vehicle)
    check_suspension(vehicle)
    check_air(vehicle)
    check_body(vehicle)
    check_differentials(vehicle)
    check_actuators(vehicle)
    check_sensors(vehicle)
    _check_fits_on_its_wheels(vehicle)
    _check_springs_carry_it(vehicle)
    for curves in vehicle.travel_curves.values():
        check_knots(curves)


def _check_tires(vehicle: DerivedValues) -> None:
    """Either one tire for all wheels, or one for each axle."""
    names = ("tire", "front_tire", "rear_tire")
    given = {name: getattr(vehicle, name) for name in names if getattr(vehicle, name) is not None}
    for name, tire in given.items():
        if not isinstance(tire, Tire):
            raise InputError(name, tire, "a Tire, as returned by load_tire")
    if "tire" in given and len(given) > 1:
        other = next(name for name in given if name != "tire")
        problem = f"given together with {other}"
        raise InputError("tire", "", "either tire, or front_tire and rear_tire", problem)
    if not given:
        raise InputError("tire", None, "a Tire, as returned by load_tire")
    if len(given) == 1 and "tire" not in given:
        missing = "rear_tire" if "front_tire" in given else "front_tire"
        raise InputError(missing, None, f"both are required; {next(iter(given))} is given")
    for name in ("tire_moments", "contact_patch_shift"):
        if not isinstance(getattr(vehicle, name), bool):
            raise InputError(name, getattr(vehicle, name), "true or false")
    if vehicle.longitudinal not in ("", "from_lateral"):
        raise InputError("longitudinal", vehicle.longitudinal, "from_lateral, or nothing")
    if vehicle.model not in MODELS:
        raise InputError("model", vehicle.model, " or ".join(MODELS))


def _check_given_once(vehicle: DerivedValues, per_axle: dict[str, tuple[str, ...]]) -> None:
    """A value is given either once for both axles or for each axle."""
    for both, single in per_axle.items():
        for name in single:
            if both in vehicle.given and name in vehicle.given:
                value = vehicle.given[name]
                problem = f"{value:g} together with {both} {vehicle.given[both]:g}"
                allowed = f"either {both}, or {' and '.join(single)}"
                raise InputError(name, value, allowed, problem)


def _check_pressures(vehicle: DerivedValues) -> None:
    """Tires of Magic Formula 5.2, and those without nominal pressure, accept no pressure."""
    for axle, tire in vehicle.axle_tires.items():
        pressure = vehicle.at_axle(axle, "tire_pressure")
        if pressure is not None and of_file(tire, "NOMPRES") is None:
            name = f"{axle}_tire_pressure"
            name = name if name in vehicle.given else "tire_pressure"
            file = f" {tire.file}" if tire.file else ""
            reason = "has no NOMPRES"
            if tire.version == VERSION_WITHOUT_PRESSURE:
                reason = f"is of version {tire.version}, which has no pressure"
            raise InputError(name, pressure, f"no pressure, since the tire file{file} {reason}")


def _check_taken_from_tires(vehicle: DerivedValues) -> None:
    """A value from a tire file must be within the range of the parameter that it replaces."""
    known = parameters_of(type(vehicle))
    for name, found in vehicle.from_tires.items():
        axle = name.partition("_")[0]
        file = f" {vehicle.axle_tires[axle].file}" if vehicle.axle_tires[axle].file else ""
        known[name].validate(found.value, f"{name}, from {found.source}{file}")


def _check_roll_centres(vehicle: DerivedValues) -> None:
    """The depth that follows from a given height must be within the allowed range of depths."""
    for axle, wheel in AXLES.items():
        name = f"{axle}_roll_centre_height"
        depth = vehicle.roll_centre_depth[wheel]
        lowest, highest = ROLL_CENTRES["minimum"], ROLL_CENTRES["maximum"]
        if name in vehicle.given and not lowest <= depth <= highest:
            least, most = vehicle.cg_height - highest, vehicle.cg_height - lowest
            limit = f"from {least:g} to {most:g} m with the c.g. at {vehicle.cg_height:g} m"
            raise InputError(name, vehicle.given[name], limit)


def _check_anti_roll_bars(vehicle: DerivedValues) -> None:
    """A bar has one stiffness, given at the wheels or in roll."""
    for name, other in BAR_SPELLINGS:
        if name in vehicle.given and other in vehicle.given:
            value = vehicle.given[name]
            problem = f"{value:g} together with {other} {vehicle.given[other]:g}"
            raise InputError(name, value, "only one of the two may be given", problem)


def _check_carriers(vehicle: DerivedValues) -> None:
    """The equations hold for carriers that turn by less than a quarter turn."""
    for axle in AXLES:
        for quantity in ("camber_change", "toe_change", "carrier_pitch_change"):
            table = vehicle.given.get(f"{axle}_{quantity}", 0.0)
            if isinstance(table, tuple) and max(abs(v) for _, v in table) > LARGEST_TURN:
                allowed = f"a table of angles from {-LARGEST_TURN:g} to {LARGEST_TURN:g} rad"
                raise InputError(f"{axle}_{quantity}", table, allowed)


def _check_inertias(vehicle: DerivedValues) -> None:
    """No moment of inertia of a rigid body exceeds the sum of the other two."""
    names = ("roll_inertia", "pitch_inertia", "yaw_inertia")
    total = math.fsum(getattr(vehicle, name) for name in names)
    for name in names:
        value = getattr(vehicle, name)
        if value > total - value:
            most = total - value
            limit = f"at most the sum of the other two moments of inertia, {most:g} kg m^2"
            excess = f"{value - most:g} kg m^2 ({100 * (value - most) / most:.2g} %) more"
            if name in vehicle.given:
                scope = f"give the {MOMENT[name]} inertia of the sprung mass alone, or that of the "
                scope += f"whole vehicle as total_{name}"
                raise InputError(name, value, f"{limit}; it is {excess}: {scope}")
            whole = f"total_{name}"
            problem = f"{vehicle.given[whole]:g} leaves {value:g} kg m^2 for the sprung mass"
            raise InputError(whole, vehicle.given[whole], f"{limit}; it is {excess}", problem)
    _check_products(vehicle)


def _check_products(vehicle: DerivedValues) -> None:
    """The second moments of the mass, integrals of x x, x y ..., are positive semidefinite."""
    inertia = tensor(vehicle.inertias)
    moments = np.trace(inertia) / 2 * np.eye(len(inertia)) - inertia
    for name, (row, column) in PRODUCTS.items():
        value = vehicle.inertias[name]
        most = math.sqrt(max(moments[row, row] * moments[column, column], 0.0))
        if abs(value) > most * (1 + ROUNDING):
            given = name if name in vehicle.given else f"total_{name}"
            limit = f"from {-most:g} to {most:g} kg m^2 with these moments of inertia"
            raise InputError(given, vehicle.given.get(given, value), limit)
    if np.linalg.eigvalsh(moments).min() < -ROUNDING * np.trace(moments):
        given = next(name for name in PRODUCTS if vehicle.inertias[name])
        limit = "products of inertia that a rigid body with these moments of inertia can have"
        raise InputError(given, vehicle.inertias[given], limit)


def _check_offset(vehicle: DerivedValues) -> None:
    """The c.g. must be between left and right wheels, which all then carry a part of it."""
    offset, most = vehicle.cg_offset or 0.0, min(vehicle.per_wheel("track")) / 2
    if not abs(offset) < most:
        limit = f"less than half the smaller track, {most:g} m, to either side"
        name = "cg_offset" if "cg_offset" in vehicle.given else "total_cg_offset"
        name = "payload" if vehicle.payload else name
        problem = f"it puts the sprung c.g. {offset:g} m to the left of the middle"
        raise InputError(name, offset, limit, problem)


def _check_fits_on_its_wheels(vehicle: DerivedValues) -> None:
    """The static tire compression must be less than the tire radius."""
    for axle, wheel in AXLES.items():
        compression = float(vehicle.static_tire_compression[wheel])
        radius = float(vehicle.per_wheel("tire_radius")[wheel])
        if radius <= compression:
            name = f"{axle}_tire_radius"
            name = name if name in vehicle.given else "tire_radius"
            limit = f"more than the static compression of the {axle} tires, {compression:g} m"
            raise InputError(name, radius, limit)


def _check_springs_carry_it(vehicle: DerivedValues) -> None:
    """The static spring compression must be below the limit at which a run counts as diverged."""
    most = float(np.min(plausible_magnitudes()["suspension_compression"]))
    for axle, wheel in AXLES.items():
        name = f"{axle}_spring_stiffness"
        compression = float(vehicle.static_suspension_compression[wheel])
        if compression > most:
            stiffness = vehicle.given.get(name)
            if stiffness is None:
                table = f"{axle}_spring_force"
                allowed = f"forces that carry the sprung mass within {most:g} m of compression"
                raise InputError(table, vehicle.given[table], allowed)
            limit = f"at least {stiffness * compression / most:g} N/m to carry the sprung mass"
            raise InputError(name, stiffness, limit)


def check_one_rolling_resistance(vehicle: DerivedValues) -> None:
    """Raise InputError if rolling resistance would count twice with tire moments on."""
    name = "rolling_resistance_coefficient"
    coefficient, place = vehicle.rolling_resistance_coefficient, vehicle.stated_at.get(name, name)
    for tire in vehicle.axle_tires.values():
        if coefficient and has_moment(ROLLING_RESISTANCE, tire.coefficients):
            file = f" {tire.file}" if tire.file else ""
            own = f"the tire file{file} has its own rolling resistance (QSY1 ...)"
            allowed = f"0 with tire_moments, since {own}; or tire_moments off"
            raise InputError(place, coefficient, allowed)
