"""Magic Formula 5.2 with combined slip (Pacejka, Tire and Vehicle Dynamics, 2002, section 4.3).

Steady-state slip, no inclination, no turn slip. Coefficients and scaling factors bear the names of
the .tir file. ISO axes of the contact patch: positive lateral slip gives a negative lateral force.
A shift counts only where its scaling factor is not 0, which is a product with that factor here;
RHX1, RHY1 and RHY2 have none and always count.
"""

from collections import namedtuple

from vehicle_roll_sim.model.elementary import (
    arctan,
    cosine,
    cosine_of_arctan,
    sine,
    sine_of_twice_arctan,
)
from vehicle_roll_sim.model.jit import constants, kernel, term, math
from vehicle_roll_sim.model.records import WHEEL_COUNT, per_wheel, record_dtype

SCALING = (
    *("LFZO", "LCX", "LMUX", "LEX", "LKX", "LHX", "LVX", "LXAL"),
    *("LCY", "LMUY", "LEY", "LKY", "LHY", "LVY", "LYKA", "LVYKA"),
    *("LSGKP", "LSGAL"),
)
REQUIRED = (
    *("FNOMIN", "PCX1", "PDX1", "PKX1", "RBX1", "RCX1"),
    *("PCY1", "PDY1", "PKY1", "PKY2", "RBY1", "RCY1"),
)
OPTIONAL = (
    *("PDX2", "PEX1", "PEX2", "PEX3", "PEX4", "PKX2", "PKX3", "PHX1", "PHX2", "PVX1", "PVX2"),
    *("RBX2", "REX1", "REX2", "RHX1"),
    *("PDY2", "PEY1", "PEY2", "PEY3", "PHY1", "PHY2", "PVY1", "PVY2"),
    *("RBY2", "RBY3", "REY1", "REY2", "RHY1", "RHY2"),
    *("RVY1", "RVY2", "RVY4", "RVY5", "RVY6"),
    *("PTX1", "PTX2", "PTX3", "PTY1", "PTY2"),
)
RANGES = ("KPUMIN", "KPUMAX", "ALPMIN", "ALPMAX", "FZMIN", "FZMAX")

TIRE = record_dtype(*SCALING, *REQUIRED, *OPTIONAL, *RANGES, *per_wheel("side"))
"""Coefficients of the tire; side is -1 at the wheels where it runs mirrored, else +1."""

TireConstants = namedtuple("TireConstants", (*SCALING, *REQUIRED, *OPTIONAL))
tire_constants = constants(TireConstants)
"""The coefficients of a TIRE record as values."""


@term
def sign(value):
    return math.copysign(1.0, value) if value != 0.0 else 0.0


@term
def bent(slip, stiffness, curvature):
    """The argument of the arc tangent that shapes every curve: B x - E (B x - atan B x)."""
    stretched = stiffness * slip
    return stretched - curvature * (stretched - arctan(stretched))


@term
def sine_curve(slip, stiffness, shape, peak, curvature):
    """The Magic Formula, D sin[C atan{B x - E (B x - atan B x)}]."""
    return peak * sine(shape * arctan(bent(slip, stiffness, curvature)))


@term
def cosine_weight(slip, shift, stiffness, shape, curvature):
    """Loss of one force by the other slip, G: 1 where that slip is 0."""
    at_shift = cosine(shape * arctan(bent(shift, stiffness, curvature)))
    return cosine(shape * arctan(bent(slip + shift, stiffness, curvature))) / at_shift


@term
def friction(coefficient, load_slope, dfz):
    """Friction coefficient at a load; it keeps the sign of the file's and never passes 0."""
    value = coefficient + load_slope * dfz
    return value if value * coefficient > 0 else 0.0


@term
def longitudinal_force(kappa, fz, dfz, tire):
    """Fx0 of pure longitudinal slip (N)."""
    slip = kappa + (tire.PHX1 + tire.PHX2 * dfz) * tire.LHX
    shift = fz * (tire.PVX1 + tire.PVX2 * dfz) * tire.LVX * tire.LMUX
    peak = friction(tire.PDX1, tire.PDX2, dfz) * tire.LMUX * fz
    if peak == 0.0:
        return shift
    shape = tire.PCX1 * tire.LCX
    slope = fz * (tire.PKX1 + tire.PKX2 * dfz) * math.exp(tire.PKX3 * dfz) * tire.LKX
    curvature = (tire.PEX1 + tire.PEX2 * dfz + tire.PEX3 * dfz**2) * tire.LEX
    curvature = min(curvature * (1 - tire.PEX4 * sign(slip)), 1.0)
    return sine_curve(slip, slope / (shape * peak), shape, peak, curvature) + shift


@term
def lateral_force(alpha, fz, dfz, tire):
    """Fy0 of pure lateral slip (N)."""
    nominal = tire.LFZO * tire.FNOMIN
    slip = alpha + (tire.PHY1 + tire.PHY2 * dfz) * tire.LHY
    shift = fz * (tire.PVY1 + tire.PVY2 * dfz) * tire.LVY * tire.LMUY
    peak = friction(tire.PDY1, tire.PDY2, dfz) * tire.LMUY * fz
    if peak == 0.0:
        return shift
    shape = tire.PCY1 * tire.LCY
    slope = tire.PKY1 * nominal * tire.LKY * sine_of_twice_arctan(fz / (tire.PKY2 * nominal))
    curvature = (tire.PEY1 + tire.PEY2 * dfz) * tire.LEY
    curvature = min(curvature * (1 - tire.PEY3 * sign(slip)), 1.0)
    return sine_curve(slip, slope / (shape * peak), shape, peak, curvature) + shift


@term
def longitudinal_weight(alpha, kappa, dfz, tire):
    """Gx alpha: what lateral slip leaves of the longitudinal force."""
    stiffness = tire.RBX1 * cosine_of_arctan(tire.RBX2 * kappa) * tire.LXAL
    curvature = min(tire.REX1 + tire.REX2 * dfz, 1.0)
    return cosine_weight(alpha, tire.RHX1, stiffness, tire.RCX1, curvature)


@term
def lateral_weight(alpha, kappa, dfz, tire):
    """Gy kappa: what longitudinal slip leaves of the lateral force."""
    stiffness = tire.RBY1 * cosine_of_arctan(tire.RBY2 * (alpha - tire.RBY3)) * tire.LYKA
    curvature = min(tire.REY1 + tire.REY2 * dfz, 1.0)
    return cosine_weight(kappa, tire.RHY1 + tire.RHY2 * dfz, stiffness, tire.RCY1, curvature)


@term
def slip_ply_steer(alpha, kappa, fz, dfz, tire):
    """SVy kappa: the lateral force that longitudinal slip brings along (N), LVYKA permitting."""
    reach = friction(tire.PDY1, tire.PDY2, dfz) * tire.LMUY * fz
    reach *= (tire.RVY1 + tire.RVY2 * dfz) * cosine_of_arctan(tire.RVY4 * alpha)
    return reach * sine(tire.RVY5 * arctan(tire.RVY6 * kappa)) * tire.LVYKA


@term
def tire_forces(kappa, alpha, fz, side, tire):
    """Longitudinal and lateral force (N) at slip kappa, slip angle alpha (rad) and load fz (N).

    `side` is -1 for a tire that runs mirrored. Without load there is no force.
    """
    if fz <= 0.0:
        return 0.0, 0.0
    nominal = tire.LFZO * tire.FNOMIN
    dfz = (fz - nominal) / nominal
    mirrored = side * alpha
    fx = longitudinal_weight(mirrored, kappa, dfz, tire) * longitudinal_force(kappa, fz, dfz, tire)
    fy = lateral_weight(mirrored, kappa, dfz, tire) * lateral_force(mirrored, fz, dfz, tire)
    return fx, side * (fy + slip_ply_steer(mirrored, kappa, fz, dfz, tire))


@kernel
def forces_of_tires(tire, outputs):
    """Longitudinal and lateral force (N) of every tire along and across its wheel."""
    tire = tire_constants(tire)
    for i in range(WHEEL_COUNT):
        outputs.tire_longitudinal[i], outputs.tire_lateral[i] = tire_forces(
            outputs.slip_ratio[i],
            outputs.slip_angle[i],
            outputs.normal_force[i],
            outputs.side[i],
            tire,
        )
