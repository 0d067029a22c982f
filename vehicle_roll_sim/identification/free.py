"""What can be identified: names, where each value acts, its start, bounds and scale."""

import dataclasses
from collections.abc import Iterable, Mapping, Sequence

from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.identification.free_value import Free
from vehicle_roll_sim.identification.sensors import OFFSET, SENSOR_VALUES, Sensors, sensor_name
from vehicle_roll_sim.input_errors import InputError, unknown_name
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire.keys import KEYS
from vehicle_roll_sim.vehicle.vehicle_file import TIRES

FIELD = "free"
AXLES = ("front", "rear")
SCALINGS = tuple(name for name, key in KEYS.items() if name[0] == "L" and key.default == 1.0)
"""Scaling factors of a tire file."""
FACTORS = (1e-2, 1e2)
"""Bounds of a factor."""
SHARE_OF_RANGE = 1e-3
"""Of the declared range: scale of a parameter that starts at 0."""


def free_of(names: Iterable[str], vehicle: Vehicle, compared: Sequence[str]) -> list[Free]:
    """The values of these names; raises InputError for one that is unknown or has no value.

    compared: quantities that the logs have.
    """
    names = list(names)
    for name in names:
        if names.count(name) > 1:
            raise InputError(FIELD, name, "each name once", "given twice")
    if not names:
        raise InputError(FIELD, "", "one or more names", "nothing to identify")
    found = [_free(name, vehicle, compared) for name in names]
    _check_apart(names)
    return found


def _check_apart(names: Sequence[str]) -> None:
    """Raise InputError for a value of both axles together with that of one of them."""
    for name in names:
        singles = [f"{axle}_{name}" for axle in AXLES]  # also of tire.KEY
        for single in singles:
            if single in names:
                allowed = "one value for both axles, or values of axles"
                raise InputError(FIELD, name, allowed, f"{name} together with {single}")


def _free(name: str, vehicle: Vehicle, compared: Sequence[str]) -> Free:
    sensors = {
        sensor_name(quantity, kind): (quantity, kind)
        for quantity in compared
        for kind in SENSOR_VALUES
    }
    known = parameters_of(Vehicle)
    if name == OFFSET.name or name in sensors:
        kind = OFFSET if name == OFFSET.name else SENSOR_VALUES[sensors[name][1]]
        quantity = "" if name == OFFSET.name else sensors[name][0]
        return kind.free(quantity)
    if "." in name:
        return _of_tire(name, vehicle)
    if name in known and known[name].kind is float:
        return _of_vehicle(name, vehicle)
    if all(f"{axle}_{name}" in known for axle in AXLES):
        return _factor(name, vehicle)
    if name in known and known[name].is_curve and not isinstance(getattr(vehicle, name), tuple):
        return _of_vehicle(name, vehicle)
    every = [*known, *sensors, OFFSET.name, *(f"tire.{key}" for key in SCALINGS)]
    raise unknown_name(name, every, FIELD)


def _of_vehicle(name: str, vehicle: Vehicle) -> Free:
    declared = parameters_of(Vehicle)[name]
    value = getattr(vehicle, name)
    value = vehicle.given.get(name, value)
    if value is None or isinstance(value, tuple):
        allowed = f"a parameter with a value to start from: --set {name}=VALUE"
        raise InputError(FIELD, name, allowed, f"{name} is a table or has no value")
    scale = abs(value) or SHARE_OF_RANGE * (declared.maximum - declared.minimum)
    bounds = (declared.minimum, declared.maximum)
    return Free(name, value, *bounds, scale, declared.unit, declared.description)


def _factor(name: str, vehicle: Vehicle) -> Free:
    """A factor common to the parameters of both axles."""
    both = [_of_vehicle(f"{axle}_{name}", vehicle) for axle in AXLES]
    for each in both:
        if each.start == 0.0:
            raise InputError(FIELD, name, f"{each.name} other than 0 to start from", "it is 0")
    limits = [(each.lower / each.start, each.upper / each.start) for each in both]
    lower = max(FACTORS[0], *(min(pair) for pair in limits))
    upper = min(FACTORS[1], *(max(pair) for pair in limits))
    about = f"factor of {both[0].name} and {both[1].name}"
    return Free(name, 1.0, lower, upper, 1.0, "", about)


def _of_tire(name: str, vehicle: Vehicle) -> Free:
    head, _, key = name.partition(".")
    if head not in TIRES or key not in SCALINGS:
        raise unknown_name(name, [f"{tire}.{k}" for tire in TIRES for k in SCALINGS], FIELD)
    value = vehicle.axle_tires["rear" if head == "rear_tire" else "front"].coefficients[key]
    if not value > 0.0:
        raise InputError(FIELD, name, "a scaling factor above 0 to start from", f"it is {value:g}")
    whose = "both axles" if head == "tire" else f"the {head.partition('_')[0]} axle"
    about = f"scaling factor of the tires of {whose}: {KEYS[key].meaning}"
    return Free(name, value, value * FACTORS[0], value * FACTORS[1], value, "", about)


def applied(vehicle: Vehicle, values: Mapping[str, float]) -> tuple[Vehicle, Sensors]:
    """The vehicle and its sensors with identified values. Raises InputError if they do not fit."""
    known = parameters_of(Vehicle)
    numbers, tires, sensors = {}, {}, {}
    for name, value in values.items():
        if "." in name:
            head, _, key = name.partition(".")
            for axle in AXLES if head == "tire" else (head.partition("_")[0],):
                tires.setdefault(axle, {})[key] = value
        elif name in known:
            numbers[name] = value
        elif all(f"{axle}_{name}" in known for axle in AXLES):
            for each in (f"{axle}_{name}" for axle in AXLES):
                numbers[each] = value * _of_vehicle(each, vehicle).start
        else:
            sensors[name] = value
    changed = vehicle.with_values(numbers) if numbers else vehicle
    return _on_scaled_tires(changed, tires), Sensors(sensors)


def _on_scaled_tires(vehicle: Vehicle, scalings: Mapping[str, Mapping[str, float]]) -> Vehicle:
    """The vehicle with scaling factors of the tires of some axles replaced."""
    if not scalings:
        return vehicle
    of_axles = {
        axle: tire.with_coefficients(**scalings.get(axle, {}))
        for axle, tire in vehicle.axle_tires.items()
    }
    if vehicle.tire is not None and of_axles["front"] == of_axles["rear"]:
        return dataclasses.replace(vehicle, tire=of_axles["front"])
    both = {f"{axle}_tire": tire for axle, tire in of_axles.items()}
    return dataclasses.replace(vehicle, tire=None, **both)
