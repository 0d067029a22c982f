"""The vehicles that come with the package, by name; docs/vehicles.md has their origins."""

import csv
import errno
import math
import os
from pathlib import Path

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.text_file import read_text
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.vehicle_file import PRESETS, load_vehicle, preset

SHIPPED = {
    "reference": "the vehicle of Shim and Ghike (2007), a car with a high c.g.",
    "small_sedan": "Ford Escort",
    "large_sedan": "upper-class sedan",
    "suv": "SUV with a high c.g.",
    "van": "VW Vanagon",
    "delivery_truck": "delivery truck with 3.3 t of cargo",
    "city_bus": "city bus with passengers",
    "formula_student": "Formula Student car with driver",
    "tenth_scale": "model car of scale 1 : 10",
}
"""Name and description of each."""
LIFT_SPEEDS = "two_wheel_lift.csv"
"""The file of the speeds of two-wheel lift, written by benchmarks/two_wheel_lift.py."""


def vehicle_named(name: str | Path) -> Vehicle:
    """Read a vehicle file, or the shipped vehicle of that name if there is no such file.

    Raises InputError.
    """
    if str(name) in SHIPPED and not Path(name).exists():
        return preset(str(name))
    try:
        return load_vehicle(name)
    except InputError as error:
        if error.problem != os.strerror(errno.ENOENT) or Path(name).suffix or Path(name).exists():
            raise
    allowed = "the name of a vehicle file, or one of " + ", ".join(SHIPPED)
    raise InputError("vehicle", str(name), allowed, f"{name} does not exist")


def lift_speeds() -> dict[str, float]:
    """Entry speed (m/s) of the fishhook at which two wheels first lift, by shipped vehicle.

    nan if they do not up to 40 m/s, or if the manoeuvre is not defined for the vehicle.
    """
    rows = csv.DictReader(read_text(PRESETS / LIFT_SPEEDS).splitlines())
    return {row["vehicle"]: float(row["speed"] or math.nan) for row in rows}
