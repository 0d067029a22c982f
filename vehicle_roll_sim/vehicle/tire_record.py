"""The record of a tire for the equations: its coefficients, and values derived from them."""

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.records import LF, LR, RF, RR
from vehicle_roll_sim.model.tire.coefficients import INCLINED, NEUTRAL, PRESSURE, TIRE
from vehicle_roll_sim.model.tire.factors import factors_of
from vehicle_roll_sim.vehicle.tire.moments import moments_of

MIRRORED = {"left": (RF, RR), "right": (LF, LR), "symmetric": (RF, RR)}
"""Wheels at which a tire is mirrored, by the side of the vehicle for which its file was made.

A symmetric tire is treated as one for the left: the wheels of an axle are mirror images.
"""


def tire_record(
    coefficients: dict[str, float],
    version: str,
    side: str,
    pressure: float | None,
    *,
    combined: bool,
    moments: bool,
) -> np.ndarray:
    """A tire as input to the equations: an array of one TIRE record, shape (1,).

    coefficients: by their names in the .tir file, in SI units; those that are missing have no
    effect. pressure: Pa; None: that of the file, else the nominal one. combined: whether slip in
    one direction takes force from the other. moments: whether moments are computed, if the tire has
    any. Raises InputError for a pressure if the coefficients do not depend on it.
    """
    values = NEUTRAL | {name: coefficients[name] for name in NEUTRAL if name in coefficients}
    nominal = coefficients.get("NOMPRES", 0.0)
    if pressure is not None and not nominal > 0.0:
        allowed = "a tire file of version 6.1 or 6.2 with NOMPRES, or no pressure"
        raise InputError("pressure", pressure, allowed)
    pressure = coefficients.get("INFLPRES") if pressure is None else pressure
    change = (pressure - nominal) / nominal if pressure and nominal > 0.0 else 0.0
    moments = moments and bool(moments_of(values))
    tire = np.zeros(1, TIRE)
    for name, value in (values | factors_of(values, change)).items():
        tire[name] = value
    tire["version"], tire["combined"], tire["moments"] = float(version), combined, moments
    tire["from_6_1"] = version != "5.2"
    tire["pressure_change"] = change
    tire["pressure_effect"] = (1 + change) ** values["QSY8"]
    tire["plain"] = version == "5.2" and combined and not moments and _is_plain(values, change)
    radii = ("VERTICAL_STIFFNESS", "UNLOADED_RADIUS")
    effective = any(values[name] != 0.0 for name in ("DREFF", "FREFF"))
    tire["rolls_on_own_radius"] = effective and all(values[name] > 0.0 for name in radii)
    tire["side"] = 1.0
    tire["side"][0, list(MIRRORED[side])] = -1.0
    return tire


def _is_plain(values: dict[str, float], pressure_change: float) -> bool:
    """Whether the forces depend neither on inclination nor on pressure."""
    absent = ("LGAX", "LGAY", "LKYC")
    dead = {"PDX3", "RBX3"} if values["LGAX"] == 0.0 else set()
    if values["LGAY"] == 0.0:
        dead |= {name for name in INCLINED if "Y" in name} - {"PKY4"}
    if values["LVYKA"] == 0.0:
        dead.add("RVY3")
    alive = [name for name in INCLINED if name not in absent and name not in dead]
    alive += PRESSURE if pressure_change != 0.0 else ()
    return all(values[name] == NEUTRAL[name] for name in alive)
