"""Slip stiffnesses and pure-slip curves of a tire in closed form, without inclination.

Equations 4.E9 to 4.E30 of Pacejka (2012) with the coefficients of any version and without shifts;
c: coefficients by name in SI units. They serve to check a tire before it is used; the simulation
does not use them.
"""

import math
from typing import NamedTuple

LARGEST_EXPONENT = 700.0
"""Limit of the argument of exp, to prevent overflow."""


def nominal_load(c: dict[str, float]) -> float:
    """Fz0': the scaled nominal load (N)."""
    return c["LFZO"] * c["FNOMIN"]


def pressure_change(c: dict[str, float]) -> float:
    """dp: the relative change of pressure; 0 if the file gives no pressure."""
    actual, nominal = c["INFLPRES"], c["NOMPRES"]
    return (actual - nominal) / nominal if actual > 0.0 and nominal > 0.0 else 0.0


def cornering_stiffness(c: dict[str, float], load: float) -> float:
    """Ky, the slope of Fy at zero slip (N/rad; 4.E25), negative in ISO signs."""
    change = pressure_change(c)
    peak = c["PKY1"] * nominal_load(c) * (1 + c["PPY1"] * change)
    at = c["PKY2"] * (1 + c["PPY2"] * change)
    relative = load / nominal_load(c) / at if at else math.inf
    return peak * math.sin(c["PKY4"] * math.atan(relative)) * c["LKY"]


def slip_stiffness(c: dict[str, float], load: float) -> float:
    """Kx, the slope of Fx at zero slip (N; 4.E15), positive."""
    change, dfz = pressure_change(c), load / nominal_load(c) - 1.0
    pressure = 1 + c["PPX1"] * change + c["PPX2"] * change * change
    slope = (c["PKX1"] + c["PKX2"] * dfz) * math.exp(min(c["PKX3"] * dfz, LARGEST_EXPONENT))
    return load * slope * pressure * c["LKX"]


def friction(c: dict[str, float], axis: str, load: float) -> float:
    """The peak friction coefficient along axis X or Y, of either sign (4.E13, 4.E23)."""
    change, dfz = pressure_change(c), load / nominal_load(c) - 1.0
    first, second = c[f"PP{axis}3"], c[f"PP{axis}4"]
    pressure = 1 + first * change + second * change * change
    return (c[f"PD{axis}1"] + c[f"PD{axis}2"] * dfz) * pressure * c[f"LMU{axis}"]


class Curve(NamedTuple):
    """D, C, B, E without its part of the sign of slip, that part, and the scaling factor of E.

    All are 0 where there is no force.
    """

    peak: float
    shape: float
    stiffness: float
    curvature: float
    asymmetry: float
    scale: float

    def force(self, slip: float) -> float:
        """D sin[C atan{B x - E (B x - atan B x)}], the force at pure slip (N; 4.E9, 4.E19)."""
        bend = self.curvature * (1 - self.asymmetry * math.copysign(1.0, slip))
        x, bend = self.stiffness * slip, min(bend * self.scale, 1.0)
        return self.peak * math.sin(self.shape * math.atan(x - bend * (x - math.atan(x))))


NO_FORCE = Curve(*[0.0] * len(Curve._fields))


def curve(c: dict[str, float], axis: str, load: float) -> Curve:
    """The curve of the force along axis X or Y at a load (N)."""
    dfz = load / nominal_load(c) - 1.0
    shape, peak = c[f"PC{axis}1"] * c[f"LC{axis}"], friction(c, axis, load) * load
    if shape * peak == 0.0:
        return NO_FORCE
    slope = slip_stiffness(c, load) if axis == "X" else cornering_stiffness(c, load)
    bend = c[f"PE{axis}1"] + c[f"PE{axis}2"] * dfz
    if axis == "X":
        bend += c["PEX3"] * dfz * dfz
    asymmetry = c["PEX4"] if axis == "X" else c["PEY3"]
    return Curve(peak, shape, slope / (shape * peak), bend, asymmetry, c[f"LE{axis}"])
