"""Magic Formula 5.2 with combined slip (Pacejka, Tire and Vehicle Dynamics, 2002, section 4.3).

Steady-state slip, no inclination, no turn slip. Coefficients and scaling factors have the names of
the .tir file. ISO axes of the contact patch: positive lateral slip gives a negative lateral force.
Shifts are multiplied by their scaling factors and vanish if these are 0; RHX1, RHY1 and RHY2 have
no scaling factor and always apply.

Everything is built from one curve, sin[C atan{B x - E (B x - atan B x)}]: the forces at pure slip,
their weighting functions (cosines, as 1 - 2 sin^2 of half the angle), and the lateral force induced
by longitudinal slip. Therefore x, B, C and E of all curves of all wheels are computed first, then
all sines in vectorized loops, and then the forces.
"""

from vehicle_roll_sim.model.compiled.elementary import (
    arctan,
    cosine_of_arctan,
    sine,
    sine_of_twice_arctan,
)
from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.records import (
    CURVE_COUNT,
    FRONT,
    LATERAL,
    LATERAL_AT_SHIFT,
    LATERAL_WEIGHT,
    LONGITUDINAL,
    LONGITUDINAL_AT_SHIFT,
    LONGITUDINAL_WEIGHT,
    LR,
    MAIN_CURVES,
    PLY_STEER,
    REAR,
    WHEEL_COUNT,
)
from vehicle_roll_sim.model.tire.coefficients import tire_constants


@term
def sign(value):
    return math.copysign(1.0, value) if value != 0.0 else 0.0


@term
def relative_load(fz, tire):
    """dfz: normal load (N) above the nominal load, relative to the nominal load (-)."""
    nominal = tire.LFZO * tire.FNOMIN
    return (fz - nominal) / nominal


@term
def friction(coefficient, load_slope, dfz):
    """Friction coefficient at a load; clipped at 0, so that it keeps the sign of the file's."""
    value = coefficient + load_slope * dfz
    return value if value * coefficient > 0 else 0.0


@term
def stiffness_factor(slope, shape, peak):
    """B of a curve from its slope at zero slip; 0 if the peak is 0."""
    return slope / (shape * peak) if peak != 0.0 else 0.0


@term
def longitudinal_curve(kappa, fz, dfz, stiffening, peak, tire):
    """x, B, C and E of Fx0, the force at pure longitudinal slip. stiffening: exp(PKX3 dfz)."""
    slip = kappa + (tire.PHX1 + tire.PHX2 * dfz) * tire.LHX
    shape = tire.PCX1 * tire.LCX
    slope = fz * (tire.PKX1 + tire.PKX2 * dfz) * stiffening * tire.LKX
    curvature = (tire.PEX1 + tire.PEX2 * dfz + tire.PEX3 * dfz * dfz) * tire.LEX
    curvature = min(curvature * (1 - tire.PEX4 * sign(slip)), 1.0)
    return slip, stiffness_factor(slope, shape, peak), shape, curvature


@term
def lateral_curve(alpha, fz, dfz, peak, tire):
    """x, B, C and E of Fy0, the force at pure lateral slip."""
    nominal = tire.LFZO * tire.FNOMIN
    slip = alpha + (tire.PHY1 + tire.PHY2 * dfz) * tire.LHY
    shape = tire.PCY1 * tire.LCY
    slope = tire.PKY1 * nominal * tire.LKY * sine_of_twice_arctan(fz / (tire.PKY2 * nominal))
    curvature = (tire.PEY1 + tire.PEY2 * dfz) * tire.LEY
    curvature = min(curvature * (1 - tire.PEY3 * sign(slip)), 1.0)
    return slip, stiffness_factor(slope, shape, peak), shape, curvature


@term
def longitudinal_weight_curve(alpha, kappa, dfz, tire):
    """x, B, half of C, and E of Gx alpha, the weighting function of the longitudinal force."""
    stiffness = tire.RBX1 * cosine_of_arctan(tire.RBX2 * kappa) * tire.LXAL
    curvature = min(tire.REX1 + tire.REX2 * dfz, 1.0)
    return alpha + tire.RHX1, stiffness, tire.RCX1 / 2, curvature


@term
def lateral_weight_curve(alpha, kappa, dfz, tire):
    """x, B, half of C, and E of Gy kappa, the weighting function of the lateral force."""
    stiffness = tire.RBY1 * cosine_of_arctan(tire.RBY2 * (alpha - tire.RBY3)) * tire.LYKA
    curvature = min(tire.REY1 + tire.REY2 * dfz, 1.0)
    return kappa + (tire.RHY1 + tire.RHY2 * dfz), stiffness, tire.RCY1 / 2, curvature


@term
def slip_ply_steer(alpha, dfz, peak, tire):
    """DVy kappa: peak of the lateral force induced by longitudinal slip (N)."""
    reach = peak * (tire.RVY1 + tire.RVY2 * dfz) * cosine_of_arctan(tire.RVY4 * alpha)
    return reach * tire.LVYKA


@term
def keep_curve(curve, i, parts, outputs):
    """Store x, B, C and E of a curve of wheel i in `outputs`."""
    slip, stiffness, shape, curvature = parts
    place = curve * WHEEL_COUNT + i
    outputs.curve_slip[place], outputs.curve_stiffness[place] = slip, stiffness
    outputs.curve_shape[place], outputs.curve_curvature[place] = shape, curvature


@kernel
def peaks_and_shifts(tire, outputs):
    """Peaks and vertical shifts of the forces at pure slip (N), and other functions of load."""
    for i in range(WHEEL_COUNT):
        fz = outputs.normal_force[i]
        dfz = relative_load(fz, tire)
        outputs.stiffening[i] = math.exp(tire.PKX3 * dfz)
        outputs.longitudinal_peak[i] = friction(tire.PDX1, tire.PDX2, dfz) * tire.LMUX * fz
        outputs.lateral_peak[i] = friction(tire.PDY1, tire.PDY2, dfz) * tire.LMUY * fz
        shift = fz * (tire.PVX1 + tire.PVX2 * dfz) * tire.LVX
        outputs.longitudinal_shift[i] = shift * tire.LMUX
        shift = fz * (tire.PVY1 + tire.PVY2 * dfz) * tire.LVY
        outputs.lateral_shift[i] = shift * tire.LMUY


@kernel
def curves(tire, outputs):
    """x, B, C and E of every curve of every wheel, and slip angles (rad) from their tangents."""
    tire = tire_constants(tire)
    for i in range(WHEEL_COUNT):
        outputs.slip_angle[i] = arctan(outputs.slip_tangent[i])
        kappa, alpha = outputs.slip_ratio[i], outputs.side[i] * outputs.slip_angle[i]
        fz, dfz = outputs.normal_force[i], relative_load(outputs.normal_force[i], tire)
        x_peak, y_peak = outputs.longitudinal_peak[i], outputs.lateral_peak[i]
        fx = longitudinal_curve(kappa, fz, dfz, outputs.stiffening[i], x_peak, tire)
        gx = longitudinal_weight_curve(alpha, kappa, dfz, tire)
        gy = lateral_weight_curve(alpha, kappa, dfz, tire)
        y_shift = tire.RHY1 + tire.RHY2 * dfz
        keep_curve(LONGITUDINAL, i, fx, outputs)
        keep_curve(LATERAL, i, lateral_curve(alpha, fz, dfz, y_peak, tire), outputs)
        keep_curve(LONGITUDINAL_WEIGHT, i, gx, outputs)
        keep_curve(LATERAL_WEIGHT, i, gy, outputs)
        keep_curve(LONGITUDINAL_AT_SHIFT, i, (tire.RHX1, gx[1], gx[2], gx[3]), outputs)
        keep_curve(LATERAL_AT_SHIFT, i, (y_shift, gy[1], gy[2], gy[3]), outputs)
        keep_curve(PLY_STEER, i, (kappa, tire.RVY6, tire.RVY5, 0.0), outputs)
        outputs.ply_steer[i] = slip_ply_steer(alpha, dfz, y_peak, tire)


@kernel
def has_main_curves_only(tire):
    """Whether weighting functions have no shift and slip ratio induces no lateral force."""
    shifts = abs(tire.RHX1) + abs(tire.RHY1) + abs(tire.RHY2)
    return shifts == 0.0 and tire.LVYKA == 0.0


@term
def sines_of_curves(count, outputs):
    """sin[C atan{B x - E (B x - atan B x)}] of the first `count` elements; the others are 0."""
    for k in range(count):
        stretched = outputs.curve_stiffness[k] * outputs.curve_slip[k]
        excess = stretched - arctan(stretched)
        outputs.curve_bend[k] = stretched - outputs.curve_curvature[k] * excess
    for k in range(count):
        outputs.curve_angle[k] = outputs.curve_shape[k] * arctan(outputs.curve_bend[k])
    for k in range(count):
        outputs.curve_sine[k] = sine(outputs.curve_angle[k])
    for k in range(count, CURVE_COUNT * WHEEL_COUNT):
        outputs.curve_sine[k] = 0.0


@term
def weight(half, half_at_shift):
    """G, a ratio of cosines, from the sines of half the angles; 1 if the other slip is 0."""
    return (1 - 2 * half * half) / (1 - 2 * half_at_shift * half_at_shift)


@term
def sine_of(curve, i, outputs):
    """The sine of a curve of wheel i."""
    return outputs.curve_sine[curve * WHEEL_COUNT + i]


@kernel
def tire_forces(tires, outputs):
    """Longitudinal and lateral force of every tire (N), along and across its wheel, and moments.

    tires: the TIRE records of front and rear axle. From normal load, slip ratio and tangent of the
    slip angle in `outputs`; 0 without load.
    """
    if tires[FRONT].shared != 0.0:
        forces_of_tire(tires[FRONT], 0, WHEEL_COUNT, outputs)
    else:
        forces_of_tire(tires[FRONT], 0, LR, outputs)
        forces_of_tire(tires[REAR], LR, WHEEL_COUNT, outputs)


@kernel
def forces_of_tire(tire, first, end, outputs):
    """Forces of one kind of tire, at the wheels from `first` to before `end`.

    The loops are over all wheels nevertheless, so that they are vectorized.
    """
    peaks_and_shifts(tire, outputs)
    curves(tire, outputs)
    if has_main_curves_only(tire):
        sines_of_curves(MAIN_CURVES * WHEEL_COUNT, outputs)
    else:
        sines_of_curves(CURVE_COUNT * WHEEL_COUNT, outputs)
    for i in range(WHEEL_COUNT):
        x_peak, x_shift = outputs.longitudinal_peak[i], outputs.longitudinal_shift[i]
        y_peak, y_shift = outputs.lateral_peak[i], outputs.lateral_shift[i]
        gx = weight(
            sine_of(LONGITUDINAL_WEIGHT, i, outputs), sine_of(LONGITUDINAL_AT_SHIFT, i, outputs)
        )
        gy = weight(sine_of(LATERAL_WEIGHT, i, outputs), sine_of(LATERAL_AT_SHIFT, i, outputs))
        fx = gx * (x_peak * sine_of(LONGITUDINAL, i, outputs) + x_shift)
        fy = gy * (y_peak * sine_of(LATERAL, i, outputs) + y_shift)
        fy += outputs.ply_steer[i] * sine_of(PLY_STEER, i, outputs)
        loaded, mine = outputs.normal_force[i] > 0.0, first <= i < end
        fx, fy = fx if loaded else 0.0, outputs.side[i] * fy if loaded else 0.0
        outputs.tire_longitudinal[i] = fx if mine else outputs.tire_longitudinal[i]
        outputs.tire_lateral[i] = fy if mine else outputs.tire_lateral[i]
        outputs.overturning_moment[i] = 0.0
        outputs.rolling_resistance_moment[i] = 0.0
        outputs.aligning_moment[i] = 0.0
