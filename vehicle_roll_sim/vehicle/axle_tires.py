"""Vehicle values taken from a tire file: radius, and vertical and lateral stiffness."""

import math
from typing import NamedTuple

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire import vertical
from vehicle_roll_sim.vehicle.tire_file import Tire

KEYS = {"tire_radius": "UNLOADED_RADIUS", "tire_stiffness": "VERTICAL_STIFFNESS"}
"""Keys of a tire file that replace missing parameters of a vehicle."""
SOFTEST, STIFFEST = 1e3, 1e8
"""N/m: limits of a computed lateral stiffness."""


class FromTire(NamedTuple):
    """A value (SI), and in words where it comes from."""

    value: float
    source: str


def radius_of(axle: str, tire: Tire) -> FromTire:
    """The radius (m) from the tire file, if the vehicle file gives none.

    Raises InputError if the tire file does not have it.
    """
    return FromTire(_required("tire_radius", axle, tire), "UNLOADED_RADIUS of the tire file")


def progression_of(axle: str, tire: Tire) -> FromTire:
    """The progression (1/m) from the tire file, which goes with its stiffness; see `tire.spring`.

    Raises InputError if the tire file has no stiffness.
    """
    _required("tire_stiffness", axle, tire)
    value = vertical.progression(tire.coefficients)
    source = "Q_FZ2 of the tire file" if value else "the tire file has none"
    return FromTire(value, source)


def stiffness_of(axle: str, tire: Tire, pressure: float | None, progression: float) -> FromTire:
    """The stiffness at zero compression (N/m) from the tire file, if the vehicle file gives none.

    pressure: inflation pressure (Pa), None for that of the file. progression: 1/m. Raises
    InputError if the tire file does not have it.
    """
    nominal = _required("tire_stiffness", axle, tire)
    stiffness = vertical_stiffness(tire, pressure)
    source = "VERTICAL_STIFFNESS of the tire file"
    if progression:
        stiffness *= vertical.initial_share(nominal, progression, tire.coefficients["FNOMIN"])
        source += " at nominal load, converted to zero load"
    return FromTire(stiffness, source)


def _required(name: str, axle: str, tire: Tire) -> float:
    """A value of the tire file for a parameter of KEYS."""
    key = KEYS[name]
    value = of_file(tire, key)
    if value is None:
        field = name if name == "tire_radius" else f"{axle}_{name}"
        file = f" {tire.file}" if tire.file else ""
        raise InputError(field, None, f"required, since the tire file{file} has no {key}")
    return value


def vertical_stiffness(tire: Tire, pressure: float | None) -> float:
    """VERTICAL_STIFFNESS at an inflation pressure (N/m); 0 if the file does not have one.

    pressure: Pa; None: that of the file.
    """
    change = pressure_change(tire, pressure)
    return tire.coefficients["VERTICAL_STIFFNESS"] * (1.0 + tire.coefficients["PFZ1"] * change)


def of_file(tire: Tire, key: str) -> float | None:
    """A positive value of the tire file; None if it does not have one."""
    value = tire.coefficients[key]
    return value if 0.0 < value < math.inf else None


def pressure_change(tire: Tire, pressure: float | None) -> float:
    """dp: relative deviation of the inflation pressure (Pa) from the nominal one (-)."""
    return float(tire.shared_record(pressure)["pressure_change"][0])


def lateral_stiffness(
    tire: Tire, pressure: float | None, load: float, radius: float, shortest: float
) -> FromTire:
    """Lateral stiffness of a tire (N/m) under its static load (N).

    That of the file; if it has none, cornering stiffness over relaxation length, cy = Kya / sigma.
    radius: unloaded radius (m), used for the relaxation length if the file has none. shortest:
    lower limit of relaxation lengths (m).
    """
    given = of_file(tire, "LATERAL_STIFFNESS")
    if given is not None:
        factor = carcass_factor(tire, pressure, load)
        value = min(max(given * factor, SOFTEST), STIFFEST)
        return FromTire(value, "LATERAL_STIFFNESS of the tire file at static load")
    cornering = abs(cornering_stiffness(tire, pressure, load))
    length = relaxation_length(tire, load, radius)
    source = "cornering stiffness over relaxation length at static load"
    if length <= 0.0:
        length, source = radius, "cornering stiffness over tire radius at static load"
    return FromTire(min(max(cornering / max(length, shortest), SOFTEST), STIFFEST), source)


def carcass_factor(tire: Tire, pressure: float | None, load: float) -> float:
    """Ratio of the lateral stiffness at a load (N) and pressure (Pa) to the nominal one (A3.10)."""
    c, dp = tire.coefficients, pressure_change(tire, pressure)
    nominal = c["LFZO"] * c["FNOMIN"]
    dfz = (load - nominal) / nominal
    of_load = 1.0 + c["PCFY1"] * dfz + c["PCFY2"] * dfz * dfz
    return of_load * (1.0 + c["PCFY3"] * dp)


def cornering_stiffness(tire: Tire, pressure: float | None, load: float) -> float:
    """Kya of an upright tire (N/rad) at a load (N); negative with coefficients in ISO signs."""
    c, dp = tire.coefficients, pressure_change(tire, pressure)
    nominal = c["LFZO"] * c["FNOMIN"]
    flattening = c["PKY2"] * (1.0 + c["PPY2"] * dp)
    curve = math.sin(c["PKY4"] * math.atan(load / (flattening * nominal)))
    return c["PKY1"] * nominal * (1.0 + c["PPY1"] * dp) * curve * c["LKY"]


def relaxation_length(tire: Tire, load: float, radius: float) -> float:
    """Lateral relaxation length (m) of Magic Formula 5.2 at a load (N); 0 if the file has none."""
    c = tire.coefficients
    if c["PTY1"] == 0.0 or c["PTY2"] == 0.0:
        return 0.0
    ratio = load / (c["PTY2"] * c["LFZO"] * c["FNOMIN"])
    return c["PTY1"] * math.sin(2.0 * math.atan(ratio)) * radius * c["LFZO"] * c["LSGAL"]
