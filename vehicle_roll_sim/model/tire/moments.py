"""Moments of the contact patch: terms of one wheel (Pacejka, 2012, section 4.3.2).

Axes of the contact patch (ISO-W): overturning moment Mx about the x axis (4.E69), rolling
resistance My about the y axis (4.E70), aligning moment Mz about the z axis (4.E31-E49, E71-E78).
gamma: inclination in the axes of the tire, mirrored if the tire is (rad).
"""

from vehicle_roll_sim.model.compiled.elementary import (
    arctan,
    arctan_of_hypotenuse,
    cosine,
    cosine_of_arctan,
    exponential,
    logarithm,
    sine,
)
from vehicle_roll_sim.model.compiled.jit import math, term
from vehicle_roll_sim.model.tire.pure_slip import inverse

LOW_SPEED = 1.0
"""m/s: below this speed, moments that depend on the rolling direction fade out."""
SMALLEST_LOAD = 1e-300
"""Of the nominal load: keeps a logarithm finite."""


@term
def direction(speed):
    """1 forwards, -1 backwards, with a smooth transition below LOW_SPEED (speed: m/s)."""
    share = max(-1.0, min(1.0, speed / LOW_SPEED))
    return share * (1.5 - 0.5 * share * share)


@term
def equivalent_slip(angle, induced):
    """Equivalent slip angle (rad), as large as the combined slip (E77, E78).

    angle: slip angle with its shift (rad). induced: Kx kappa / Ky, the tangent equivalent to the
    slip ratio.
    """
    return math.copysign(arctan_of_hypotenuse(angle, induced), angle)


@term
def trail_peak(gamma, fz, dfz, forward, tire):
    """Dt cos alpha' LFZO: pneumatic trail at zero slip (m; E33, E42, E43)."""
    inclined = tire.LGAZ * gamma
    peak = fz * (tire.UNLOADED_RADIUS / (tire.LFZO * tire.FNOMIN))
    peak *= tire.QDZ1 + tire.QDZ2 * dfz
    peak *= tire.trail_growth
    peak *= (1 + tire.QDZ3 * inclined + tire.QDZ4 * inclined * inclined) * tire.LTR
    return peak * forward * tire.LFZO


@term
def trail_curve(alpha, induced, gamma, dfz, grip, tire):
    """x, B, half of C, and E of the trail over the equivalent slip angle (E34, E35, E40-E44)."""
    inclined = tire.LGAZ * gamma
    angle = alpha + tire.QHZ1 + tire.QHZ2 * dfz + (tire.QHZ3 + tire.QHZ4 * dfz) * inclined
    stiffness = (tire.QBZ1 + (tire.QBZ2 + tire.QBZ3 * dfz) * dfz) * tire.stiffness_over_friction
    stiffness *= inverse(grip)
    stiffness *= 1 + tire.QBZ4 * inclined + tire.QBZ5 * abs(inclined)
    curvature = tire.QEZ1 + (tire.QEZ2 + tire.QEZ3 * dfz) * dfz
    side = (tire.QEZ4 + tire.QEZ5 * inclined) * arctan(stiffness * tire.QCZ1 * angle)
    curvature = min(curvature * (1 + 2 / math.pi * side), 1.0)
    return equivalent_slip(angle, induced), stiffness, tire.QCZ1 / 2, curvature


@term
def residual_moment(angle, induced, gamma, fz, dfz, slope, forward, grip, tire):
    """Mzr: residual aligning moment (N m; E36-E38, E45-E47).

    angle: slip angle with the shift at which the lateral force is 0 (rad). slope: By Cy.
    """
    inclined = tire.LGAZ * gamma
    stiffness = tire.QBZ9 * tire.stiffness_over_friction * inverse(grip)
    stiffness += tire.QBZ10 * slope
    camber = (tire.QDZ8 + tire.QDZ9 * dfz) * tire.camber_moment_growth
    camber += (tire.QDZ10 + tire.QDZ11 * dfz) * abs(inclined)
    moment = (tire.QDZ6 + tire.QDZ7 * dfz) * tire.LRES + camber * inclined * tire.LKZC
    moment *= fz * tire.UNLOADED_RADIUS * tire.LMUY * grip * forward
    return moment * cosine_of_arctan(stiffness * equivalent_slip(angle, induced))


@term
def longitudinal_arm(gamma, dfz, fy, tire):
    """s: arm of the longitudinal force about the z axis (m; E76)."""
    arm = tire.SSZ1 + tire.arm_per_force * fy
    arm += (tire.SSZ3 + tire.SSZ4 * dfz) * tire.LGAZ * gamma
    return tire.UNLOADED_RADIUS * arm * tire.LS


@term
def overturning_wave(gamma, fz, fy, tire):
    """The product of cosine and sine in Mx (E69)."""
    per_load = tire.per_nominal_load
    stretched, force = tire.QSX6 * (fz * per_load), fy * per_load
    wave = cosine(tire.QSX5 * arctan(stretched * stretched))
    return wave * sine(tire.QSX7 * gamma + tire.QSX8 * arctan(tire.QSX9 * force))


@term
def overturning_moment(gamma, fz, fy, with_wave, tire):
    """Mx (N m; E69). QSX1-QSX11 and QSX12-QSX14 are alternatives; a file gives one set.

    with_wave: None if QSX4 and QSX10 are 0.
    """
    load, force = fz * tire.per_nominal_load, fy * tire.per_nominal_load
    part = tire.QSX1 * tire.LVMX - tire.QSX2 * gamma * tire.overturning_growth
    part += tire.QSX3 * force - tire.QSX12 * gamma * abs(gamma)
    if with_wave is not None:
        part += tire.QSX4 * overturning_wave(gamma, fz, fy, tire)
        part += tire.QSX10 * arctan(tire.QSX11 * load) * gamma
    moment = fz * part + fy * (tire.QSX13 + tire.QSX14 * abs(gamma))
    return tire.UNLOADED_RADIUS * tire.LMX * moment


@term
def load_power(fz, tire):
    """(Fz / Fz0)^QSY7 of E70."""
    load = max(fz, 0.0) / tire.FNOMIN
    power = exponential(tire.QSY7 * logarithm(max(load, SMALLEST_LOAD)))
    is_load = (tire.QSY7 == 1.0) | (load <= 0.0)  # `or` would make two loops of one
    return load if is_load else power


@term
def rolling_resistance_moment(gamma, fz, fx, speed, load_power, tire):
    """My, negative for a wheel rolling forward (N m; E70).

    speed: rolling speed (m/s). load_power: (Fz / Fz0)^QSY7.
    """
    ratio = speed * tire.per_reference_speed
    part = tire.QSY1 + tire.resistance_per_force * fx + tire.QSY3 * abs(ratio)
    part += tire.QSY4 * (ratio * ratio) * (ratio * ratio)
    part += (tire.QSY5 + tire.resistance_per_load * fz) * gamma * gamma
    moment = -tire.UNLOADED_RADIUS * tire.FNOMIN * part * tire.LMY
    return moment * load_power * tire.pressure_effect
