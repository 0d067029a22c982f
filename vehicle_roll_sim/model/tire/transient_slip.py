"""Transient slip with relaxation lengths, valid from standstill to any speed.

The single contact point model (Pacejka, Tire and Vehicle Dynamics, 2002, chapter 7). Its states are
the slips developed in the contact patch: one for the slip ratio and one for the tangent of the slip
angle. With the rolling speed V and a sliding speed Vs of the wheel (rw - V along, or across),

    dx/dt = (Vs - |V| x) / SIGMA - w (x - XHELD) / RELEASE,

and the input of the Magic Formula is x + TAU w dx/dt. At speed w is 0: x approaches the
steady-state slip Vs / |V| over the relaxation length SIGMA. Towards standstill, where there is no
relaxation by rolling, w approaches 1: slip beyond the peak of the tire's own curve is released
towards XHELD, the nearest slip up to the peak, and the tire's spring is damped with
TAU = SIGMA / 15 m/s (less longitudinally, if that would stop a light wheel within 1 ms).
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.elementary import cosine, exponential, sine_of_twice_arctan
from vehicle_roll_sim.model.compiled.jit import kernel, math, not_unrolled, term
from vehicle_roll_sim.model.records import LR, WHEEL_COUNT
from vehicle_roll_sim.model.tire.coefficients import all_tire_constants
from vehicle_roll_sim.model.tire.pure_slip import relative_load
from vehicle_roll_sim.model.tire.standing import held_slips

LOW_SPEED = 1.0
"""m/s: rolling speed below which the standstill terms (w) act."""
DAMPING_SPEED = 15.0
"""m/s: relaxation length over TAU, the damping time of the tire at standstill (s)."""
QUICKEST_DAMPING = 1000.0
"""1/s: largest rate at which that damping may decelerate a wheel."""
RELEASE_TIME = 0.02
"""RELEASE (s): time constant of the decay of slip beyond XHELD, and of any slip off the ground."""


@kernel
def relaxation_lengths(tire, least, outputs):
    """Longitudinal and lateral relaxation length of every wheel, at least `least` (m).

    After `terms_of_loads`. Files of version 5.2 give them (PTX1-PTX3, PTY1, PTY2); in 6.1 and 6.2
    they follow from the stiffness of the carcass.
    """
    if tire.version > 6.0:
        lengths_by_stiffness(tire, least, outputs)
    else:
        lengths_by_coefficients(tire, least, outputs)


@kernel
def lengths_by_coefficients(tire, least, outputs):
    """Relaxation lengths of 5.2, at least `least` (m)."""
    terms, is_plain = outputs.tire_terms, tire.plain != 0.0
    tire = all_tire_constants(tire)
    if is_plain:
        for i in range(WHEEL_COUNT):
            dfz = relative_load(outputs.normal_force[i], tire)
            terms.relaxation_fading[i] = math.exp(-tire.PTX3 * dfz)
    else:
        for i in range(not_unrolled(WHEEL_COUNT)):
            dfz = relative_load(outputs.normal_force[i], tire)
            terms.relaxation_fading[i] = exponential(-tire.PTX3 * dfz)
    nominal, has_lateral = tire.LFZO * tire.FNOMIN, tire.PTY2 != 0.0
    for i in range(not_unrolled(WHEEL_COUNT)):
        fz, radius = outputs.normal_force[i], outputs.unloaded_radius[i]
        dfz = relative_load(fz, tire)
        along = fz * (tire.PTX1 + tire.PTX2 * dfz) * terms.relaxation_fading[i]
        along *= radius / tire.FNOMIN * tire.LSGKP
        across = tire.PTY1 * sine_of_twice_arctan(fz / (tire.PTY2 * nominal))
        across = across if has_lateral else 0.0
        across *= radius * tire.LFZO * tire.LSGAL
        terms.longitudinal_relaxation[i] = max(along, least)
        terms.lateral_relaxation[i] = max(across, least)


@kernel
def lengths_by_stiffness(tire, least, outputs):
    """Relaxation lengths of 6.1 and 6.2, at least `least` (m).

    Slip stiffness and cornering stiffness of the upright tire over the stiffnesses of the carcass
    (A3.9, A3.10); 0 if the file does not give those.
    """
    terms, tire = outputs.tire_terms, all_tire_constants(tire)
    for i in range(not_unrolled(WHEEL_COUNT)):
        dfz = terms.relative_load[i]
        stiffness = 1 + tire.PCFX1 * dfz + tire.PCFX2 * dfz * dfz
        stiffness *= tire.longitudinal_carcass_stiffness
        along = abs(terms.slip_stiffness[i]) * tire.LSGKP / stiffness
        terms.longitudinal_relaxation[i] = max(along if stiffness > 0.0 else 0.0, least)
        stiffness = 1 + tire.PCFY1 * dfz + tire.PCFY2 * dfz * dfz
        stiffness *= tire.lateral_carcass_stiffness
        across = abs(terms.upright_stiffness[i]) * tire.LSGAL / stiffness
        terms.lateral_relaxation[i] = max(across if stiffness > 0.0 else 0.0, least)


@term
def standstill(rolling):
    """w: 1 at standstill, 0 from LOW_SPEED on, smooth in between; rolling: speed (m/s)."""
    speed = abs(rolling)
    return 0.5 + 0.5 * cosine(math.pi * speed / LOW_SPEED) if speed < LOW_SPEED else 0.0


@term
def slip_rate(slip, rolling, sliding, length, released):
    """dx/dt (1/s) of the equation above; released: w (x - XHELD)."""
    return (sliding - abs(rolling) * slip) / length - released / RELEASE_TIME


@kernel
def transient_slip(state, vehicle, tires, outputs):
    """Slip ratio and tangent of the slip angle of every wheel, and the rates of its slip states."""
    along, across = state[at.LONGITUDINAL_SLIP], state[at.LATERAL_SLIP]
    for i in range(WHEEL_COUNT):
        outputs.patch_slip_ratio[i], outputs.patch_slip_tangent[i] = along[i], across[i]
        outputs.unloaded_radius[i] = vehicle.tire_radius[i]
    slips_of_tire(tires.front, 0, vehicle, outputs)
    if tires.front.shared == 0.0:
        slips_of_tire(tires.rear, LR, vehicle, outputs)


@kernel
def slips_of_tire(tire, first, vehicle, outputs):
    """Those of one kind of tire, at the wheels from `first` on. Without load the slips decay."""
    terms = outputs.tire_terms
    relaxation_lengths(tire, vehicle.minimum_relaxation_length, outputs)
    slow = False
    for i in range(WHEEL_COUNT):
        slow = slow or abs(outputs.rolling[i]) < LOW_SPEED
        terms.longitudinal_release[i] = terms.lateral_release[i] = 0.0
        terms.longitudinal_damping[i] = terms.lateral_damping[i] = 0.0
    if slow:
        hold_slips(tire, vehicle, outputs)
    for i in range(not_unrolled(WHEEL_COUNT)):
        along, across = outputs.patch_slip_ratio[i], outputs.patch_slip_tangent[i]
        rolling, sliding = outputs.rolling[i], outputs.sliding[i]
        long, lateral = terms.longitudinal_relaxation[i], terms.lateral_relaxation[i]
        released = terms.longitudinal_release[i]
        along_rate = slip_rate(along, rolling, outputs.tread[i] - rolling, long, released)
        released = terms.lateral_release[i]
        across_rate = slip_rate(across, rolling, sliding, lateral, released)
        loaded, mine = outputs.normal_force[i] > 0.0, i >= first
        damping = terms.longitudinal_damping[i]
        kappa = along + damping * along_rate if loaded else along
        damping = terms.lateral_damping[i]
        tangent = across + damping * across_rate if loaded else across
        along_rate = along_rate if loaded else -along / RELEASE_TIME
        across_rate = across_rate if loaded else -across / RELEASE_TIME
        outputs.slip_ratio[i] = kappa if mine else outputs.slip_ratio[i]
        outputs.slip_tangent[i] = tangent if mine else outputs.slip_tangent[i]
        along_rate = along_rate if mine else outputs.longitudinal_slip_rate[i]
        across_rate = across_rate if mine else outputs.lateral_slip_rate[i]
        outputs.longitudinal_slip_rate[i], outputs.lateral_slip_rate[i] = along_rate, across_rate


@kernel
def hold_slips(tire, vehicle, outputs):
    """The standstill terms of every wheel: w (x - XHELD) and TAU w, which is 0 at speed."""
    terms = outputs.tire_terms
    for i in range(WHEEL_COUNT):
        terms.longitudinal_release[i] = terms.lateral_release[i] = 0.0
        terms.longitudinal_damping[i] = terms.lateral_damping[i] = 0.0
        weight, fz = standstill(outputs.rolling[i]), outputs.normal_force[i]
        if weight > 0.0 and fz > 0.0:
            along, across = outputs.patch_slip_ratio[i], outputs.patch_slip_tangent[i]
            side = outputs.side[i]
            gamma, grip = side * outputs.inclination[i], outputs.road_friction[i]
            along_held, across_held = held_slips(along, across, gamma, side, fz, grip, tire)
            terms.longitudinal_release[i] = weight * (along - along_held)
            terms.lateral_release[i] = weight * (across - across_held)
            slope = fz * tire.PKX1 * tire.LKX * outputs.unloaded_radius[i] ** 2  # about Kx r^2
            firm = max(DAMPING_SPEED, slope / (vehicle.wheel_inertia * QUICKEST_DAMPING))
            terms.longitudinal_damping[i] = terms.longitudinal_relaxation[i] / firm * weight
            terms.lateral_damping[i] = terms.lateral_relaxation[i] / DAMPING_SPEED * weight
