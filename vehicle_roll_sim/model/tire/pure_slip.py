"""Forces at pure slip: terms of one wheel (Pacejka, 2012, section 4.3.2, equations 4.E1-4.E30).

`gamma` is the inclination in the axes of the tire, mirrored if the tire is (rad). With None, the
terms of inclination and inflation pressure are omitted at compile time. Coefficients that a version
of the Magic Formula lacks are neutral (`coefficients.NEUTRAL`); other differences between versions
are stated where they occur.
"""

from vehicle_roll_sim.model.compiled.elementary import arctan, sine, sine_of_twice_arctan
from vehicle_roll_sim.model.compiled.jit import math, term


@term
def sign(value):
    return math.copysign(1.0, value) if value != 0.0 else 0.0


@term
def above_zero(factor):
    """A factor limited to at least 0, so that no force changes sign far outside the fit's range."""
    return factor if factor > 0.0 else 0.0


@term
def relative_load(fz, tire):
    """dfz: normal load (N) above the nominal load, relative to the nominal load (-) (E1, E2)."""
    nominal = tire.LFZO * tire.FNOMIN
    return (fz - nominal) / nominal


@term
def friction(coefficient, load_slope, dfz):
    """Friction coefficient at a load, limited to 0 so that it keeps the sign given in the file."""
    value = coefficient + load_slope * dfz
    return value if value * coefficient > 0 else 0.0


@term
def longitudinal_friction(gamma, dfz, tire):
    """mux without its scaling factor (E13)."""
    mu = friction(tire.PDX1, tire.PDX2, dfz)
    if gamma is not None:
        inclined = tire.LGAX * gamma
        mu *= tire.longitudinal_grip
        mu *= above_zero(1 - tire.PDX3 * inclined * inclined)
    return mu


@term
def lateral_friction(gamma, dfz, tire):
    """muy without its scaling factor (E23)."""
    if gamma is None:
        return friction(tire.PDY1, tire.PDY2, dfz)
    inclined = tire.LGAY * gamma
    factor = above_zero(1 - tire.PDY3 * inclined * inclined)
    return upright_lateral_friction(dfz, tire) * factor


@term
def upright_lateral_friction(dfz, tire):
    """muy without its scaling factor and without inclination."""
    return friction(tire.PDY1, tire.PDY2, dfz) * tire.lateral_grip


@term
def camber_shift(gamma, fz, dfz, tire):
    """SVyg: vertical shift of the lateral force due to inclination (N; E28)."""
    slope = fz * (tire.PVY3 + tire.PVY4 * dfz) * tire.LKYC * tire.LMUY
    return slope * tire.LGAY * gamma


@term
def inverse(value):
    """1 / value; 0 for 0."""
    return 1.0 / value if value != 0.0 else 0.0


@term
def stiffness_factor(slope, shape, peak):
    """B of a curve from its slope at zero slip; 0 if the peak is 0 (E16, E26)."""
    return slope / (shape * peak) if peak != 0.0 else 0.0


@term
def slip_stiffness(gamma, fz, dfz, stiffening, tire):
    """Kx kappa: slope of Fx0 at zero slip (N; E15). stiffening: exp(PKX3 dfz)."""
    slope = fz * (tire.PKX1 + tire.PKX2 * dfz) * stiffening * tire.LKX
    if gamma is not None:
        slope *= tire.slip_stiffening
    return slope


@term
def cornering_stiffness(gamma, fz, tire):
    """Ky alpha: slope of Fy0 at zero slip (N/rad; E25)."""
    nominal = tire.LFZO * tire.FNOMIN
    if gamma is None:
        return tire.PKY1 * nominal * tire.LKY * sine_of_twice_arctan(fz / (tire.PKY2 * nominal))
    return stiffness_of_wave(gamma, cornering_wave(gamma, fz, tire), tire)


@term
def cornering_wave(gamma, fz, tire):
    """The sine in Ky alpha (E25); it depends only on the size of the inclination, through PKY5."""
    inclined, nominal = tire.LGAY * gamma, tire.LFZO * tire.FNOMIN
    load = (tire.PKY2 + tire.PKY5 * inclined * inclined) * nominal
    wave = sine(tire.PKY4 * arctan(fz / (load * tire.cornering_load_growth)))
    return wave if wave * tire.PKY2 > 0.0 else 0.0


@term
def stiffness_of_wave(gamma, wave, tire):
    """Ky alpha from its sine (N/rad; E25)."""
    upright = upright_stiffness_of_wave(wave, tire)
    return upright * above_zero(1 - tire.PKY3 * abs(tire.LGAY * gamma))


@term
def upright_stiffness_of_wave(wave, tire):
    """Ky alpha without inclination (N/rad)."""
    return tire.largest_cornering_stiffness * wave


@term
def longitudinal_curve(kappa, dfz, slope, peak, tire):
    """x, B, C and E of Fx0, the force at pure longitudinal slip (E10, E11, E14, E17)."""
    slip = kappa + (tire.PHX1 + tire.PHX2 * dfz) * tire.LHX
    shape = tire.PCX1 * tire.LCX
    curvature = (tire.PEX1 + tire.PEX2 * dfz + tire.PEX3 * dfz * dfz) * tire.LEX
    curvature = min(curvature * (1 - tire.PEX4 * sign(slip)), 1.0)
    return slip, stiffness_factor(slope, shape, peak), shape, curvature


@term
def lateral_slip_shift(gamma, fz, dfz, per_slope, tire):
    """SHy: horizontal shift of the lateral force (rad; E27, E30).

    From version 6.1 on, the shift follows from the camber force Kyg0 gamma; in 5.2 it is given
    directly, as PHY3 gamma. per_slope: 1 / Ky, or 0 if Ky is 0.
    """
    shift = (tire.PHY1 + tire.PHY2 * dfz) * tire.LHY
    if gamma is not None:
        inclined = tire.LGAY * gamma
        force = fz * (tire.PKY6 + tire.PKY7 * dfz) * tire.camber_stiffening
        force = force * tire.LKYC * inclined - camber_shift(gamma, fz, dfz, tire)
        shift += tire.PHY3 * inclined + tire.from_6_1 * (force * per_slope)
    return shift


@term
def lateral_curve(alpha, gamma, dfz, shift, slope, peak, tire):
    """x, B, C and E of Fy0, the force at pure lateral slip (E20, E21, E24)."""
    slip = alpha + shift
    shape = tire.PCY1 * tire.LCY
    curvature = (tire.PEY1 + tire.PEY2 * dfz) * tire.LEY
    if gamma is None:
        curvature = min(curvature * (1 - tire.PEY3 * sign(slip)), 1.0)
    else:
        inclined = tire.LGAY * gamma
        side = (tire.PEY3 + tire.PEY4 * inclined) * sign(slip)
        curvature = min(curvature * (1 + tire.PEY5 * inclined * inclined - side), 1.0)
    return slip, stiffness_factor(slope, shape, peak), shape, curvature
