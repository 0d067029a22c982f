"""The Magic Formula 5.2, 6.1 and 6.2 with combined slip (Pacejka, 2012, section 4.3.2).

Steady-state slip, no turn slip. One set of equations, those of 6.2; coefficients that a version
lacks are neutral. Coefficients and scaling factors have the names of the .tir file; a number such
as E19 means equation 4.E19. ISO axes of the contact patch: positive lateral slip gives a negative
lateral force. Angles are in the axes of the tire, mirrored if the tire is.

Almost everything is built from one curve, sin[C atan{B x - E (B x - atan B x)}]: the forces at pure
slip, their weighting functions and the trail (cosines, as 1 - 2 sin^2 of half the angle).
Therefore x, B, C and E of all curves of all wheels are computed first, then all sines in
vectorized loops, and then the forces and moments. The compiler vectorizes only loops with long
bodies: it unrolls the others first. Loops are therefore as long as they can be. The longest read
all inputs before they write anything: since records might overlap, compiled code would otherwise
read all coefficients in advance and keep copies of them.
"""

from vehicle_roll_sim.model.compiled.elementary import arctan, cosine_of_arctan
from vehicle_roll_sim.model.compiled.jit import kernel, term
from vehicle_roll_sim.model.records import LR, WHEEL_COUNT
from vehicle_roll_sim.model.tire import moments, pure_slip
from vehicle_roll_sim.model.tire.coefficients import all_tire_constants, tire_constants
from vehicle_roll_sim.model.tire.combined_slip import (
    lateral_weight_curve,
    longitudinal_weight_curve,
    slip_ply_steer,
)
from vehicle_roll_sim.model.tire.curves import (
    keep_curve,
    keep_weight,
    sine_of,
    sines_of_curves,
    weight_of,
)
from vehicle_roll_sim.model.tire.loads import terms_of_loads
from vehicle_roll_sim.model.tire.pure_slip import camber_shift, relative_load
from vehicle_roll_sim.model.work_space import (
    CURVE_COUNT,
    FORCE_CURVES,
    LATERAL,
    LATERAL_AT_SHIFT,
    LATERAL_WEIGHT,
    LONGITUDINAL,
    LONGITUDINAL_AT_SHIFT,
    LONGITUDINAL_WEIGHT,
    MAIN_CURVES,
    TRAIL,
    UPRIGHT_LATERAL,
)


@kernel
def tire_forces(tires, outputs):
    """Longitudinal and lateral force (N) and moments of every tire, without a vehicle.

    tires: an array of one TIRES record. outputs: an array of OUTPUTS records, with these inputs:
    normal load, slip ratio, tangent of the slip angle and inclination; for the moments also the
    speeds of rolling and of the tread. All are 0 without load. Moments (N m) are 0 if they are
    switched off.
    """
    both = tires[0]
    for k in range(len(outputs)):
        terms_of_loads(both, outputs[k])
        forces_at_slips(both, outputs[k])


@kernel
def forces_at_slips(tires, outputs):
    """As `tire_forces`, of one TIRES and one OUTPUTS record, with `terms_of_loads` as input."""
    forces_of_tire(tires.front, 0, outputs)
    if tires.front.shared == 0.0:
        forces_of_tire(tires.rear, LR, outputs)


@kernel
def forces_of_tire(tire, first, outputs):
    """Forces and moments of one kind of tire, at the wheels from `first` on.

    The loops run over all wheels nevertheless, so that they can be vectorized.
    """
    if tire.plain != 0.0:
        plain_curves(tire, outputs)
        forces_from_curves(tire, first, None, None, outputs)
    elif tire.moments == 0.0:
        curves_of_wheels(tire, True, None, outputs)
        sines_of_curves(FORCE_CURVES * WHEEL_COUNT, outputs.tire_terms)
        forces_from_curves(tire, first, None, None, outputs)
    else:
        curves_of_wheels(tire, True, True, outputs)
        sines_of_curves(CURVE_COUNT * WHEEL_COUNT, outputs.tire_terms)
        if tire.QSX4 != 0.0 or tire.QSX10 != 0.0:
            forces_from_curves(tire, first, True, True, outputs)
        else:
            forces_from_curves(tire, first, True, None, outputs)


@kernel
def plain_curves(tire, outputs):
    """All curves without inclination, pressure and moments."""
    curves_of_wheels(tire, None, None, outputs)
    ply_steers(tire, outputs)
    shifts = abs(tire.RHX1) + abs(tire.RHY1) + abs(tire.RHY2)
    if shifts == 0.0:
        sines_of_curves(MAIN_CURVES * WHEEL_COUNT, outputs.tire_terms)
    else:
        sines_of_curves(FORCE_CURVES * WHEEL_COUNT, outputs.tire_terms)


@kernel
def curves_of_wheels(tire, inclined, with_moments, outputs):
    """x, B, C and E of every curve, and slip angles (rad) from their tangents.

    Also peaks and vertical shifts of the forces at pure slip (N; E12, E18, E22, E29). inclined:
    None for the plain form, without inclination and pressure. with_moments: None without the curves
    of the aligning moment. Older versions of numba prune branches by arguments that are None alone.
    """
    terms = outputs.tire_terms
    tire = tire_constants(tire) if inclined is None else all_tire_constants(tire)
    for i in range(WHEEL_COUNT):
        side, fz, kappa = outputs.side[i], outputs.normal_force[i], outputs.slip_ratio[i]
        tangent, grip = outputs.slip_tangent[i], outputs.road_friction[i]
        angle = arctan(tangent)
        alpha = side * angle
        if inclined is None:
            gamma, dfz = None, relative_load(fz, tire)
            kx = pure_slip.slip_stiffness(gamma, fz, dfz, terms.stiffening[i], tire)
            ky = pure_slip.cornering_stiffness(gamma, fz, tire)
            per_ky = ky
        else:
            gamma, dfz = side * outputs.inclination[i], terms.relative_load[i]
            kx = terms.slip_stiffness[i]
            ky = pure_slip.stiffness_of_wave(gamma, terms.cornering_wave[i], tire)
            per_ky = pure_slip.inverse(ky)
        if with_moments is not None:
            upright_ky, rolling = terms.upright_stiffness[i], outputs.rolling[i]
        x_peak = pure_slip.longitudinal_friction(gamma, dfz, tire) * tire.LMUX * fz * grip
        y_peak = pure_slip.lateral_friction(gamma, dfz, tire) * tire.LMUY * fz * grip
        x_shift = fz * (tire.PVX1 + tire.PVX2 * dfz) * tire.LVX * tire.LMUX * grip
        y_shift = fz * (tire.PVY1 + tire.PVY2 * dfz) * tire.LVY * tire.LMUY * grip
        upright_shift = y_shift
        slip_shift = pure_slip.lateral_slip_shift(gamma, fz, dfz, per_ky, tire)
        fx = pure_slip.longitudinal_curve(kappa, dfz, kx, x_peak, tire)
        fy = pure_slip.lateral_curve(alpha, gamma, dfz, slip_shift, ky, y_peak, tire)
        gx = longitudinal_weight_curve(alpha, kappa, gamma, dfz, tire)
        gy = lateral_weight_curve(alpha, kappa, gamma, dfz, tire)
        weight_shift = tire.RHY1 + tire.RHY2 * dfz
        if inclined is not None:
            y_shift += camber_shift(gamma, fz, dfz, tire) * grip
            induced = slip_ply_steer(kappa, alpha, gamma, dfz, y_peak, tire)
        if with_moments is not None:
            forward = moments.direction(rolling) * cosine_of_arctan(tangent)
            y_zero = alpha + slip_shift + y_shift * per_ky
            ratio = kx * kappa * tire.combined * per_ky
            upright = upright_lateral(alpha, fz, dfz, upright_ky, grip, tire)
            trail = trail_of_wheel(alpha, ratio, gamma, fz, dfz, forward, grip, tire)
            slope = fy[1] * tire.PCY1 * tire.LCY
            residual = moments.residual_moment(
                y_zero, ratio, gamma, fz, dfz, slope, forward, grip, tire
            )
        outputs.slip_angle[i] = angle
        terms.longitudinal_peak[i], terms.lateral_peak[i] = x_peak, y_peak
        terms.longitudinal_shift[i], terms.lateral_shift[i] = x_shift, y_shift
        keep_curve(LONGITUDINAL, i, fx, terms)
        keep_curve(LATERAL, i, fy, terms)
        keep_weight(LONGITUDINAL_WEIGHT, LONGITUDINAL_AT_SHIFT, i, gx, tire.RHX1, terms)
        keep_weight(LATERAL_WEIGHT, LATERAL_AT_SHIFT, i, gy, weight_shift, terms)
        if inclined is not None:
            terms.ply_steer[i], terms.upright_shift[i] = induced, upright_shift
        if with_moments is not None:
            terms.upright_peak[i], terms.trail_peak[i] = upright[0], trail[0]
            terms.residual[i] = residual
            keep_curve(UPRIGHT_LATERAL, i, upright[1], terms)
            keep_curve(TRAIL, i, trail[1], terms)


@term
def upright_lateral(alpha, fz, dfz, slope, grip, tire):
    """Peak (N), and x, B, C and E of the lateral force without inclination. slope: Ky (N/rad)."""
    peak = pure_slip.upright_lateral_friction(dfz, tire) * tire.LMUY * fz * grip
    shift = (tire.PHY1 + tire.PHY2 * dfz) * tire.LHY
    return peak, pure_slip.lateral_curve(alpha, None, dfz, shift, slope, peak, tire)


@term
def trail_of_wheel(alpha, ratio, gamma, fz, dfz, forward, grip, tire):
    """Peak (m), and x, B, half of C, and E of the trail; see `moments`. ratio: Kx kappa / Ky."""
    peak = moments.trail_peak(gamma, fz, dfz, forward, tire)
    return peak, moments.trail_curve(alpha, ratio, gamma, dfz, grip, tire)


@kernel
def ply_steers(tire, outputs):
    """The lateral forces induced by slip ratio (N) in the plain form; 0 for many tires."""
    terms = outputs.tire_terms
    for i in range(WHEEL_COUNT):
        terms.ply_steer[i] = 0.0
        if tire.LVYKA != 0.0:
            kappa, alpha = outputs.slip_ratio[i], outputs.side[i] * outputs.slip_angle[i]
            dfz, peak = relative_load(outputs.normal_force[i], tire), terms.lateral_peak[i]
            terms.ply_steer[i] = slip_ply_steer(kappa, alpha, None, dfz, peak, tire)


@kernel
def forces_from_curves(tire, first, with_moments, with_wave, outputs):
    """Forces (N) and moments (N m) from the sines of the curves, at the wheels from `first` on.

    with_moments: None if the moments are 0. with_wave: None if QSX4 and QSX10 are 0.
    """
    terms = outputs.tire_terms
    lowest = tire.lowest_weight
    tire = all_tire_constants(tire)
    for i in range(WHEEL_COUNT):
        fz, side, mine = outputs.normal_force[i], outputs.side[i], i >= first
        loaded = fz > 0.0
        gx = weight_of(LONGITUDINAL_WEIGHT, LONGITUDINAL_AT_SHIFT, i, lowest, terms)
        gy = weight_of(LATERAL_WEIGHT, LATERAL_AT_SHIFT, i, lowest, terms)
        pure = terms.lateral_peak[i] * sine_of(LATERAL, i, terms) + terms.lateral_shift[i]  # (E19)
        fx = terms.longitudinal_peak[i] * sine_of(LONGITUDINAL, i, terms)
        fx = gx * (fx + terms.longitudinal_shift[i])  # (E9, E50)
        fy = gy * pure + terms.ply_steer[i]  # (E58, E66)
        mx = my = mz = 0.0
        if with_moments is not None:
            upright = terms.upright_peak[i] * sine_of(UPRIGHT_LATERAL, i, terms)
            upright += terms.upright_shift[i]
            half, residual = sine_of(TRAIL, i, terms), terms.residual[i]
            trail = terms.trail_peak[i] * (1 - 2 * half * half)  # (E73)
            gamma, dfz = side * outputs.inclination[i], terms.relative_load[i]
            power, rolling, tread = terms.load_power[i], outputs.rolling[i], outputs.tread[i]
        fx, fy = fx if loaded else 0.0, fy if loaded else 0.0
        if with_moments is not None:
            pure = tire.from_6_1 * upright + (1 - tire.from_6_1) * pure  # (E74)
            mz = residual - trail * gy * pure  # (E71, E72)
            mz += moments.longitudinal_arm(gamma, dfz, fy, tire) * fx * tire.combined
            mx = moments.overturning_moment(gamma, fz, fy, with_wave, tire)
            my = moments.direction(tread) * moments.rolling_resistance_moment(
                gamma, fz, fx, rolling, power, tire
            )
            mx, mz = side * mx if loaded else 0.0, side * mz if loaded else 0.0
            my = my if loaded else 0.0
        outputs.tire_longitudinal[i] = fx if mine else outputs.tire_longitudinal[i]
        outputs.tire_lateral[i] = side * fy if mine else outputs.tire_lateral[i]
        outputs.overturning_moment[i] = mx if mine else outputs.overturning_moment[i]
        outputs.rolling_resistance_moment[i] = my if mine else outputs.rolling_resistance_moment[i]
        outputs.aligning_moment[i] = mz if mine else outputs.aligning_moment[i]
