"""A check of a tire before it is used: its forces must oppose slip.

The upright tire is checked in pure slip, without shifts, at loads and slips within the ranges of
its file. The lateral force must oppose slip at all of them, the longitudinal force at nominal load.
If the longitudinal force fails elsewhere, as in extrapolated fits, the load range is narrowed to
the loads at which it opposes slip.
"""

import math
from typing import NamedTuple

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire import curves
from vehicle_roll_sim.vehicle.tire.text import Entry

LOWEST_LOAD, HIGHEST_LOAD, LOAD_STEPS = 0.02, 3.0, 40
"""Loads of the check, relative to the nominal load, if the file gives no range; their steps."""
SLIPS = (0.002, 0.02, 0.1, 0.3, 1.0, 1.5)
"""Slip ratios and slip angles (rad) of the check, with both signs, within the file's range."""

OF_SIDE_FORCE = ("PKY1", "PCY1")
"""Coefficients named in errors about the lateral force."""


class Fault(NamedTuple):
    """A force that acts with the slip: its coefficient, what that does, and what is allowed."""

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
    c: dict[str, float], entries: dict[str, Entry], turned: list[str]
) -> tuple[dict[str, float], list[str]]:
    """The coefficients with the load range in which the forces oppose slip, and notes on it.

    turned: the note on the sign convention that the file states, if it does. Raises InputError if
    the lateral force acts with the slip at any load, or the longitudinal force does so at nominal
    load or at all loads of the range.
    """
    nominal, loads = curves.nominal_load(c), loads_of(c)
    if fault := _fault(c, nominal):
        raise _refused(_with_remedy(fault, turned), entries)
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
        f"warning: {name} is taken as {load:.0f} N; {side} that, {fault.name} {fault.problem}, and "
        "the force would act with the slip"
    )


def _with_remedy(fault: Fault, turned: list[str]) -> Fault:
    """The fault at nominal load; a wrong cornering stiffness is one of signs."""
    if fault.name != "PKY1":
        return fault
    if turned:
        remedy = f"a stiffness below 0 in ISO axes; the file states other signs: {turned[0]}"
    else:
        remedy = (
            "a stiffness below 0, as in ISO axes (TYDEX W); to convert a fit in other axes, add "
            "SIGN_CONVENTION = 'ADAPTED_SAE' (or SAE, ADAPTED_ISO) to [MODEL]"
        )
    return fault._replace(allowed=remedy)


def _refused(fault: Fault, entries: dict[str, Entry]) -> InputError:
    entry = entries.get(fault.name, entries["PKY1"])
    return InputError(entry.where, entry.text, fault.allowed, f"{entry.text} {fault.problem}")


def _fault(c: dict[str, float], load: float) -> Fault | None:
    """The first force found to act with the slip at a load (N); None if all oppose it."""
    side, brake = curves.cornering_stiffness(c, load), curves.slip_stiffness(c, load)
    if not side < 0.0:
        problem = f"makes the cornering stiffness {side:.0f} N/rad at {load:.0f} N"
        allowed = "a stiffness below 0 at every load from FZMIN to FZMAX; see PKY2, PKY4, PPY2"
        return Fault("PKY1", problem, allowed)
    if not brake > 0.0:
        problem = f"makes the slip stiffness {brake:.0f} N at {load:.0f} N"
        allowed = "a slip stiffness above 0, so that brake slip gives a braking force"
        return Fault("PKX1" if c["PKX1"] <= 0.0 else "PKX2", problem, allowed)
    return _turning(c, "X", 1.0, load) or _turning(c, "Y", -1.0, load)


def _turning(c: dict[str, float], axis: str, sign: float, load: float) -> Fault | None:
    """The fault of a pure-slip curve that changes sign within the file's slip range."""
    low, high = ("KPUMIN", "KPUMAX") if axis == "X" else ("ALPMIN", "ALPMAX")
    curve = curves.curve(c, axis, load)
    for slip in (s * way for s in SLIPS for way in (-1.0, 1.0)):
        if c[low] <= slip <= c[high] and sign * curve.force(slip) * slip < 0.0:
            problem = f"reverses F{axis.lower()} at a slip of {slip:g} and {load:.0f} N"
            allowed = "a shape factor of at most 2, so that the force opposes slip"
            return Fault(f"PC{axis}1", problem, allowed)
    return None
