"""The Magic Formula 5.2, 6.1 and 6.2 with combined slip (Pacejka, 2012, section 4.3.2).

Steady-state slip, no turn slip. One set of equations, those of 6.2; coefficients that a version
lacks are neutral. Coefficients and scaling factors have the names of the .tir file; a number such
as E19 means equation 4.E19. ISO axes of the contact patch: positive lateral slip gives a negative
lateral force. Angles are in the axes of the tire, mirrored if the tire is.

Almost everything is built from one curve, sin[C atan{B x - E (B x - atan B x)}]: the forces at pure
slip, their weighting functions and the trail (cosines, as 1 - 2 sin^2 of half the angle), and the
lateral force induced by longitudinal slip. Therefore x, B, C and E of all curves of all wheels are
computed first, then all sines in vectorized loops, and then the forces and moments.
"""

from vehicle_roll_sim.model.compiled.elementary import arctan, cosine_of_arctan, sine
from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.records import (
    CURVE_COUNT,
    FORCE_CURVES,
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
    TRAIL,
    UPRIGHT_LATERAL,
    WHEEL_COUNT,
)
from vehicle_roll_sim.model.tire import moments, pure_slip
from vehicle_roll_sim.model.tire.coefficients import all_tire_constants, tire_constants
from vehicle_roll_sim.model.tire.combined_slip import (
    lateral_weight_curve,
    longitudinal_weight_curve,
    slip_ply_steer,
    weight,
)
from vehicle_roll_sim.model.tire.pure_slip import camber_shift, relative_load


@term
def keep_curve(curve, i, parts, terms):
    """Store x, B, C and E of a curve of wheel i."""
    slip, stiffness, shape, curvature = parts
    place = curve * WHEEL_COUNT + i
    terms.curve_slip[place], terms.curve_stiffness[place] = slip, stiffness
    terms.curve_shape[place], terms.curve_curvature[place] = shape, curvature


@kernel
def peaks_and_shifts(tire, form, outputs):
    """Peaks and vertical shifts of the forces at pure slip (N; E12, E18, E22, E29).

    Also exp(PKX3 dfz). form: None for the plain form, without inclination and pressure.
    """
    terms = outputs.tire_terms
    for i in range(WHEEL_COUNT):
        gamma = None if form is None else outputs.side[i] * outputs.inclination[i]
        fz = outputs.normal_force[i]
        dfz = relative_load(fz, tire)
        terms.stiffening[i] = math.exp(tire.PKX3 * dfz)
        mu = pure_slip.longitudinal_friction(gamma, dfz, tire)
        terms.longitudinal_peak[i] = mu * tire.LMUX * fz
        mu = pure_slip.lateral_friction(gamma, dfz, tire)
        terms.lateral_peak[i] = mu * tire.LMUY * fz
        shift = fz * (tire.PVX1 + tire.PVX2 * dfz) * tire.LVX
        terms.longitudinal_shift[i] = shift * tire.LMUX
        shift = fz * (tire.PVY1 + tire.PVY2 * dfz) * tire.LVY
        terms.lateral_shift[i] = shift * tire.LMUY
        if form is not None:  # an argument: older versions of numba prune by those alone
            terms.relative_load[i], terms.upright_shift[i] = dfz, terms.lateral_shift[i]
            terms.lateral_shift[i] += camber_shift(gamma, fz, dfz, tire)


@kernel
def curves_of_forces(tire, form, outputs):
    """x, B, C and E of every curve of the forces, and slip angles (rad) from their tangents."""
    terms = outputs.tire_terms
    tire = tire_constants(tire) if form is None else all_tire_constants(tire)
    for i in range(WHEEL_COUNT):
        gamma = None if form is None else outputs.side[i] * outputs.inclination[i]
        outputs.slip_angle[i] = arctan(outputs.slip_tangent[i])
        kappa, alpha = outputs.slip_ratio[i], outputs.side[i] * outputs.slip_angle[i]
        fz, dfz = outputs.normal_force[i], relative_load(outputs.normal_force[i], tire)
        x_peak, y_peak = terms.longitudinal_peak[i], terms.lateral_peak[i]
        kx = pure_slip.slip_stiffness(gamma, fz, dfz, terms.stiffening[i], tire)
        ky = pure_slip.cornering_stiffness(gamma, fz, tire)
        y_shift = pure_slip.lateral_slip_shift(gamma, fz, dfz, ky, tire)
        if form is not None:  # for the moments
            terms.slip_stiffness[i], terms.cornering_stiffness[i] = kx, ky
            terms.lateral_slip_shift[i] = y_shift
        fx = pure_slip.longitudinal_curve(kappa, dfz, kx, x_peak, tire)
        fy = pure_slip.lateral_curve(alpha, gamma, dfz, y_shift, ky, y_peak, tire)
        gx = longitudinal_weight_curve(alpha, kappa, gamma, dfz, tire)
        gy = lateral_weight_curve(alpha, kappa, gamma, dfz, tire)
        keep_curve(LONGITUDINAL, i, fx, terms)
        keep_curve(LATERAL, i, fy, terms)
        keep_curve(LONGITUDINAL_WEIGHT, i, gx, terms)
        keep_curve(LATERAL_WEIGHT, i, gy, terms)
        keep_curve(LONGITUDINAL_AT_SHIFT, i, (tire.RHX1, gx[1], gx[2], gx[3]), terms)
        shift = tire.RHY1 + tire.RHY2 * dfz
        keep_curve(LATERAL_AT_SHIFT, i, (shift, gy[1], gy[2], gy[3]), terms)
        keep_curve(PLY_STEER, i, (kappa, tire.RVY6, tire.RVY5, 0.0), terms)
        terms.ply_steer[i] = slip_ply_steer(alpha, gamma, dfz, y_peak, tire)


@kernel
def curves_of_moments(tire, outputs):
    """Curves and other terms of the aligning moment; see `moments`."""
    terms = outputs.tire_terms
    tire = all_tire_constants(tire)
    for i in range(WHEEL_COUNT):
        side = outputs.side[i]
        alpha, gamma = side * outputs.slip_angle[i], side * outputs.inclination[i]
        fz, dfz = outputs.normal_force[i], terms.relative_load[i]
        ky = terms.cornering_stiffness[i]
        per_stiffness = 1.0 / ky if ky != 0.0 else 0.0
        mu = pure_slip.lateral_friction(0.0, dfz, tire)
        terms.upright_peak[i] = mu * tire.LMUY * fz
        upright = pure_slip.cornering_stiffness(0.0, fz, tire)
        shift = pure_slip.lateral_slip_shift(0.0, fz, dfz, upright, tire)
        fy = pure_slip.lateral_curve(alpha, 0.0, dfz, shift, upright, terms.upright_peak[i], tire)
        keep_curve(UPRIGHT_LATERAL, i, fy, terms)
        induced = terms.slip_stiffness[i] * outputs.slip_ratio[i] * tire.combined * per_stiffness
        keep_curve(TRAIL, i, moments.trail_curve(alpha, induced, gamma, dfz, tire), terms)
        forward = moments.direction(outputs.rolling[i]) * cosine_of_arctan(outputs.slip_tangent[i])
        terms.trail_peak[i] = moments.trail_peak(gamma, fz, dfz, forward, tire)
        angle = alpha + terms.lateral_slip_shift[i] + terms.lateral_shift[i] * per_stiffness
        peak = terms.lateral_peak[i]
        terms.residual[i] = moments.residual_moment(
            angle, induced, gamma, fz, dfz, ky, peak, forward, tire
        )
    for i in range(WHEEL_COUNT):
        terms.load_power[i] = moments.load_power(outputs.normal_force[i], tire)


@kernel
def has_main_curves_only(tire):
    """Whether weighting functions have no shift and slip ratio induces no lateral force."""
    shifts = abs(tire.RHX1) + abs(tire.RHY1) + abs(tire.RHY2)
    return shifts == 0.0 and tire.LVYKA == 0.0


@term
def sines_of_curves(count, terms):
    """sin[C atan{B x - E (B x - atan B x)}] of the first `count` elements; the others are 0."""
    for k in range(count):
        stretched = terms.curve_stiffness[k] * terms.curve_slip[k]
        excess = stretched - arctan(stretched)
        terms.curve_bend[k] = stretched - terms.curve_curvature[k] * excess
    for k in range(count):
        terms.curve_angle[k] = terms.curve_shape[k] * arctan(terms.curve_bend[k])
    for k in range(count):
        terms.curve_sine[k] = sine(terms.curve_angle[k])
    for k in range(count, CURVE_COUNT * WHEEL_COUNT):
        terms.curve_sine[k] = 0.0


@term
def sine_of(curve, i, terms):
    """The sine of a curve of wheel i."""
    return terms.curve_sine[curve * WHEEL_COUNT + i]


@term
def weight_of(curve, curve_at_shift, i, lowest, terms):
    """The weight of a force of wheel i, from the two curves of its weighting function."""
    return weight(sine_of(curve, i, terms), sine_of(curve_at_shift, i, terms), lowest)


@kernel
def tire_forces(tires, outputs):
    """Longitudinal and lateral force (N) and moments of every tire.

    tires: the TIRE records of front and rear axle. Inputs in `outputs`: normal load, slip
    ratio, tangent of the slip angle and inclination; for the moments also the speeds of rolling and
    of the tread. All are 0 without load. Moments (N m) are 0 if they are switched off.
    """
    if tires[FRONT].shared != 0.0:
        forces_of_tire(tires[FRONT], 0, WHEEL_COUNT, outputs)
    else:
        forces_of_tire(tires[FRONT], 0, LR, outputs)
        forces_of_tire(tires[REAR], LR, WHEEL_COUNT, outputs)


@kernel
def forces_of_tire(tire, first, end, outputs):
    """Forces and moments of one kind of tire, at the wheels from `first` to before `end`.

    Most loops run over all wheels nevertheless, so that they can be vectorized.
    """
    terms = outputs.tire_terms
    if tire.plain != 0.0:
        plain_curves(tire, outputs)
    else:
        complete_curves(tire, outputs)
    lowest = tire.lowest_weight
    for i in range(WHEEL_COUNT):
        x_peak, x_shift = terms.longitudinal_peak[i], terms.longitudinal_shift[i]
        y_peak, y_shift = terms.lateral_peak[i], terms.lateral_shift[i]
        gx = weight_of(LONGITUDINAL_WEIGHT, LONGITUDINAL_AT_SHIFT, i, lowest, terms)
        gy = weight_of(LATERAL_WEIGHT, LATERAL_AT_SHIFT, i, lowest, terms)
        fx = gx * (x_peak * sine_of(LONGITUDINAL, i, terms) + x_shift)  # (E9, E50)
        fy = gy * (y_peak * sine_of(LATERAL, i, terms) + y_shift)  # (E19, E58)
        fy += terms.ply_steer[i] * sine_of(PLY_STEER, i, terms)  # (E66)
        loaded, mine = outputs.normal_force[i] > 0.0, first <= i < end
        fx, fy = fx if loaded else 0.0, outputs.side[i] * fy if loaded else 0.0
        outputs.tire_longitudinal[i] = fx if mine else outputs.tire_longitudinal[i]
        outputs.tire_lateral[i] = fy if mine else outputs.tire_lateral[i]
    moments_of_tire(tire, first, end, outputs)


@kernel
def plain_curves(tire, outputs):
    """All curves without inclination, pressure and moments."""
    peaks_and_shifts(tire, None, outputs)
    curves_of_forces(tire, None, outputs)
    if has_main_curves_only(tire):
        sines_of_curves(MAIN_CURVES * WHEEL_COUNT, outputs.tire_terms)
    else:
        sines_of_curves(FORCE_CURVES * WHEEL_COUNT, outputs.tire_terms)


@kernel
def complete_curves(tire, outputs):
    """All curves."""
    peaks_and_shifts(tire, True, outputs)
    curves_of_forces(tire, True, outputs)
    if tire.moments != 0.0:
        curves_of_moments(tire, outputs)
        sines_of_curves(CURVE_COUNT * WHEEL_COUNT, outputs.tire_terms)
    else:
        sines_of_curves(FORCE_CURVES * WHEEL_COUNT, outputs.tire_terms)


@kernel
def moments_of_tire(tire, first, end, outputs):
    """Overturning, rolling resistance and aligning moment, at wheels `first` to before `end`."""
    if tire.moments == 0.0:
        for i in range(first, end):
            outputs.overturning_moment[i] = outputs.rolling_resistance_moment[i] = 0.0
            outputs.aligning_moment[i] = 0.0
        return
    terms, tire = outputs.tire_terms, all_tire_constants(tire)
    for i in range(WHEEL_COUNT):
        side = outputs.side[i]
        gamma = side * outputs.inclination[i]
        fz, fx, fy = outputs.normal_force[i], outputs.tire_longitudinal[i], outputs.tire_lateral[i]
        dfz, fy = terms.relative_load[i], side * fy
        gy = weight_of(LATERAL_WEIGHT, LATERAL_AT_SHIFT, i, tire.lowest_weight, terms)
        upright = terms.upright_peak[i] * sine_of(UPRIGHT_LATERAL, i, terms)
        inclined = terms.lateral_peak[i] * sine_of(LATERAL, i, terms) + terms.lateral_shift[i]
        pure = upright + terms.upright_shift[i] if tire.version > 6.0 else inclined  # (E74)
        half = sine_of(TRAIL, i, terms)
        trail = terms.trail_peak[i] * (1 - 2 * half * half)  # (E73)
        mz = terms.residual[i] - trail * gy * pure  # (E71, E72)
        mz += moments.longitudinal_arm(gamma, dfz, fy, tire) * fx * tire.combined
        mx = moments.overturning_moment(gamma, fz, fy, tire)
        my = moments.direction(outputs.tread[i]) * moments.rolling_resistance_moment(
            gamma, fz, fx, outputs.rolling[i], terms.load_power[i], tire
        )
        loaded, mine = fz > 0.0, first <= i < end
        mx, mz = side * mx if loaded else 0.0, side * mz if loaded else 0.0
        my = my if loaded else 0.0
        outputs.overturning_moment[i] = mx if mine else outputs.overturning_moment[i]
        outputs.rolling_resistance_moment[i] = my if mine else outputs.rolling_resistance_moment[i]
        outputs.aligning_moment[i] = mz if mine else outputs.aligning_moment[i]
