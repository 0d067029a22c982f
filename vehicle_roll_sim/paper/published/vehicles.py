"""Vehicles from published values: units, and tires from cornering compliances or coefficients."""

import dataclasses
import functools
import math
from collections.abc import Iterator, Mapping

from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire_file import Tire
from vehicle_roll_sim.vehicle.vehicle_file import preset

UNITS = {None: 1.0, "in": 0.0254, "lb": 0.45359237}
"""SI units per unit of a column; None: values without a unit are in SI units."""
BASE, RATIO, WHEELBASE = "base", "ratio", "wheelbase"
COMPLIANCES = ("front_cornering_compliance", "rear_cornering_compliance")
"""Slip angle of an axle over lateral acceleration (deg/g)."""
FAR = 1000.0
"""PKY2: nominal loads at which cornering stiffness is largest, so far away that below, it is
proportional to the load to within 1e-6."""
LINEAR = {"PCX1": 1.6, "PDX1": 1.1, "PKX1": 22.0, "PCY1": 1.3, "PDY1": 10.0, "PKY1": 0.0}
"""A tire so far from its peak that its side force is proportional to the slip angle."""
COMMON = {"FNOMIN": 4000.0, "UNLOADED_RADIUS": 0.3, "RCX1": 1.0, "RCY1": 1.0}


def vehicle_of(row: Mapping, columns: Mapping[str, str], text: Mapping) -> Vehicle:
    """The vehicle of a row: published values by name, in the units of the columns or in SI units.

    text: of the file, with `base`, the shipped vehicle that has what is not published, and `tire`,
    coefficients that all tires have. Raises InputError for values that no vehicle has.
    """
    values = {name: value * UNITS[columns.get(name)] for name, value in _numbers(row)}
    if WHEELBASE in values:
        ahead = values["total_cg_to_front_axle"]
        values["total_cg_to_rear_axle"] = values.pop(WHEELBASE) - ahead
    compliances = [values.pop(name, None) for name in COMPLIANCES]
    vehicle = _shipped(row.get(BASE, text[BASE])).with_values(values)
    if None not in compliances:
        front, rear = (_tire(LINEAR | {"PKY1": -1.0 / math.radians(d)}) for d in compliances)
        return dataclasses.replace(vehicle, tire=None, front_tire=front, rear_tire=rear)
    if "tire" in text:
        return dataclasses.replace(vehicle, tire=_tire(text["tire"]))
    return vehicle


_shipped = functools.cache(preset)
"""A shipped vehicle that nobody changes."""


def _numbers(row: Mapping) -> Iterator[tuple[str, float]]:
    return ((name, value) for name, value in row.items() if name not in (BASE, RATIO))


def _tire(coefficients: Mapping[str, float]) -> Tire:
    """A tire with a cornering stiffness of PKY1 times the load, without shifts."""
    stiffness = {"PKY1": coefficients["PKY1"] * FAR / 2, "PKY2": FAR}
    return Tire(COMMON | dict(coefficients) | stiffness, side="symmetric")
