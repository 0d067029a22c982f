"""A tire is asked before it is used: its forces must resist slip.

Asked is the upright tire at pure slip and without shifts, at loads and slips within the range of
its file. The side force must resist slip at all of them, the longitudinal force at nominal load. If
the latter fails elsewhere, as extrapolated fits do, the tire is read for the loads at which it
holds.
"""

import math
from typing import NamedTuple

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire import curves
from vehicle_roll_sim.vehicle.tire.text import Entry

LOWEST_LOAD, HIGHEST_LOAD, LOAD_STEPS = 0.02, 3.0, 40
"""Loads at which a tire is asked: over the nominal load, where its file has no range."""
SLIPS = (0.002, 0.02, 0.1, 0.3, 1.0, 1.5)
"""Slip ratios, and slip angles in radians, of either sign, within the range of the file."""

OF_SIDE_FORCE = ("PKY1", "PCY1")
"""Coefficients that are blamed for a side force."""


class Fault(NamedTuple):
    """A force that pushes with the slip: what to blame, what it does, and what is allowed."""

    name: str
    problem: str
    allowed: str


def loads_of(c: dict[str, float]) -> list[float]:
    """Loads from the lowest to the highest of a file's range (N)."""
    nominal = curves.nominal_load(c)
    high = c["FZMAX"] if math.isfinite(c["FZMAX"]) else HIGHEST_LOAD * nominal
    low = min(c["FZMIN"] if c["FZMIN"] > 0.0 else LOWEST_LOAD * nominal, high)
    steps = [low + (high - low) * i / LOAD_STEPS for i in range(LOAD_STEPS + 1)]
    return [load for load in steps if load > 0.0]


def within_resistance(
    c: dict[str, float], entries: dict[str, Entry]
) -> tuple[dict[str, float], list[str]]:
    """The coefficients, with the range of loads in which the forces resist slip, and notes on it.

    Raises InputError if a side force pushes with the slip, or a longitudinal force does so at
    nominal load or at all loads of the range.
    """
    nominal, loads = curves.nominal_load(c), loads_of(c)
    if fault := _fault(c, nominal):
        raise _refused(fault, entries)
    faults = {load: _fault(c, load) for load in loads}
    found = [fault for fault in faults.values() if fault]
    right = [load for load in loads if not faults[load]]
    for fault in found:
        if fault.name in OF_SIDE_FORCE or not right:
            raise _refused(fault, entries)
    start = min(right, key=lambda load: abs(load - nominal))
    below = [load for load in loads if load < start and faults[load]]
    above = [load for load in loads if load > start and faults[load]]
    changed, notes = {}, []
    if below:
        changed["FZMIN"] = min(load for load in loads if load > below[-1])
        notes.append(_cut("FZMIN", changed["FZMIN"], "below", faults[below[-1]]))
    if above:
        changed["FZMAX"] = max(load for load in loads if load < above[0])
        notes.append(_cut("FZMAX", changed["FZMAX"], "above", faults[above[0]]))
    return c | changed, notes


def _cut(name: str, load: float, side: str, fault: Fault) -> str:
    return (
        f"warning: {name} is taken as {load:.0f} N; {side} it {fault.name} {fault.problem}, and "
        "forces would push with the slip"
    )


def _refused(fault: Fault, entries: dict[str, Entry]) -> InputError:
    entry = entries.get(fault.name, entries["PKY1"])
    return InputError(entry.where, entry.text, fault.allowed, f"{entry.text} {fault.problem}")


def _fault(c: dict[str, float], load: float) -> Fault | None:
    """The first force that pushes with the slip at a load (N)."""
    side, brake = curves.cornering_stiffness(c, load), curves.slip_stiffness(c, load)
    if not side < 0.0:
        problem = f"makes the cornering stiffness {side:.0f} N/rad at {load:.0f} N"
        allowed = (
            "a stiffness below 0, as ISO axes (TYDEX W) have it; for a fit in other axes write "
            "SIGN_CONVENTION = 'ADAPTED_SAE' (or SAE, ADAPTED_ISO) in [MODEL], and it is converted"
        )
        return Fault("PKY1", problem, allowed)
    if not brake > 0.0:
        problem = f"makes the slip stiffness {brake:.0f} N at {load:.0f} N"
        allowed = "a slip stiffness above 0, so that brake slip gives brake force"
        return Fault("PKX1" if c["PKX1"] <= 0.0 else "PKX2", problem, allowed)
    return _turning(c, "X", 1.0, load) or _turning(c, "Y", -1.0, load)


def _turning(c: dict[str, float], axis: str, sign: float, load: float) -> Fault | None:
    """The fault of a curve of pure slip that changes its sign within the range of slip."""
    low, high = ("KPUMIN", "KPUMAX") if axis == "X" else ("ALPMIN", "ALPMAX")
    for slip in (s * way for s in SLIPS for way in (-1.0, 1.0)):
        if c[low] <= slip <= c[high] and sign * curves.curve(c, axis, load, slip) * slip < 0.0:
            problem = f"reverses F{axis.lower()} at a slip of {slip:g} and {load:.0f} N"
            allowed = "a shape factor of at most 2, with which the force resists slip"
            return Fault(f"PC{axis}1", problem, allowed)
    return None
