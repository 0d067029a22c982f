"""Checks of the combined-slip weights: slip in the other direction must only reduce a force."""

import math

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire import curves
from vehicle_roll_sim.vehicle.tire.resistance import loads_of
from vehicle_roll_sim.vehicle.tire.text import Entry

LARGEST_SHAPE = 3.0
"""Of a weight, whose cosine argument then stays within 3/2 pi, so that a force does not recover."""


def check_weights(c: dict[str, float], entries: dict[str, Entry]) -> None:
    """Raise InputError for a weight that recovers at large slip, or vanishes in pure slip.

    The latter is checked at the loads of the file, for the upright tire and the largest stiffness
    factor of the weight (4.E52, 4.E60).
    """
    for axis, scale in (("X", "LXAL"), ("Y", "LYKA")):
        shape, name = c[f"RC{axis}1"], f"RC{axis}1"
        if abs(shape) > LARGEST_SHAPE:
            allowed = f"at most {LARGEST_SHAPE:g}: above that, the force recovers at larger slip"
            raise InputError(entries[name].where, entries[name].text, allowed)
        for load in loads_of(c):
            dfz = load / curves.nominal_load(c) - 1.0
            shift = c[f"RH{axis}1"] + (c["RHY2"] * dfz if axis == "Y" else 0.0)
            bend = min(c[f"RE{axis}1"] + c[f"RE{axis}2"] * dfz, 1.0)
            x = c[f"RB{axis}1"] * c[scale] * shift
            if abs(shape * math.atan(x - bend * (x - math.atan(x)))) >= math.pi / 2:
                entry = entries.get(f"RH{axis}1", entries[name])
                problem = f"{entry.text} leaves no F{axis.lower()} in pure slip"
                allowed = f"a smaller shift, so that the weight at {load:.0f} N is above 0"
                raise InputError(entry.where, entry.text, allowed, problem)
