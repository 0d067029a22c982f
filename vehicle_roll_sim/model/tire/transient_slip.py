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
from vehicle_roll_sim.model.compiled.elementary import cosine, sine_of_twice_arctan
from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.records import AXLE_COUNT, LR, WHEEL_COUNT, vehicle_constants
from vehicle_roll_sim.model.tire.pure_slip import cornering_stiffness, slip_stiffness
from vehicle_roll_sim.model.tire.standing import held_slips

LOW_SPEED = 1.0
"""m/s: rolling speed below which the standstill terms (w) act."""
DAMPING_SPEED = 15.0
"""m/s: relaxation length over TAU, the damping time of the tire at standstill (s)."""
QUICKEST_DAMPING = 1000.0
"""1/s: largest rate at which that damping may decelerate a wheel."""
RELEASE_TIME = 0.02
"""RELEASE (s): time constant of the decay of slip beyond XHELD, and of any slip off the ground."""


@term
def relaxation_lengths(fz, radius, vehicle, tire):
    """Longitudinal and lateral relaxation length at load fz (m).

    Files of version 5.2 give them (PTX1-PTX3, PTY1, PTY2); in 6.1 and 6.2 they are slip stiffness
    and cornering stiffness over the carcass stiffness (A3.9, A3.10).
    """
    nominal = tire.LFZO * tire.FNOMIN
    dfz = (fz - nominal) / nominal
    floor = vehicle.minimum_relaxation_length
    if tire.version > 6.0:
        along, across = lengths_by_stiffness(fz, dfz, tire)
        return max(along * tire.LSGKP, floor), max(across * tire.LSGAL, floor)
    along = fz * (tire.PTX1 + tire.PTX2 * dfz) * math.exp(-tire.PTX3 * dfz)
    along *= radius / tire.FNOMIN * tire.LSGKP
    across = 0.0
    if tire.PTY2 != 0.0:
        across = tire.PTY1 * sine_of_twice_arctan(fz / (tire.PTY2 * nominal))
    across *= radius * tire.LFZO * tire.LSGAL
    return max(along, floor), max(across, floor)


@kernel
def lengths_by_stiffness(fz, dfz, tire):
    """Relaxation lengths (m) of the upright tire; 0 if the file gives no carcass stiffness."""
    dp, along, across = tire.pressure_change, 0.0, 0.0
    stiffness = 1 + tire.PCFX1 * dfz + tire.PCFX2 * dfz * dfz
    stiffness *= tire.LONGITUDINAL_STIFFNESS * (1 + tire.PCFX3 * dp)
    if stiffness > 0.0:
        along = slip_stiffness(0.0, fz, dfz, math.exp(tire.PKX3 * dfz), tire) / stiffness
    stiffness = 1 + tire.PCFY1 * dfz + tire.PCFY2 * dfz * dfz
    stiffness *= tire.LATERAL_STIFFNESS * (1 + tire.PCFY3 * dp)
    if stiffness > 0.0:
        across = cornering_stiffness(0.0, fz, tire) / stiffness
    return abs(along), abs(across)


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
    vehicle = vehicle_constants(vehicle)
    for axle in range(AXLE_COUNT):
        tire = tires[axle]
        for i in range(axle * LR, axle * LR + LR):
            outputs.longitudinal_slip_rate[i], outputs.lateral_slip_rate[i], kappa, tangent = (
                damped_slip(
                    outputs.patch_slip_ratio[i],
                    outputs.patch_slip_tangent[i],
                    outputs.rolling[i],
                    outputs.sliding[i],
                    outputs.tread[i],
                    outputs.normal_force[i],
                    outputs.side[i] * outputs.inclination[i],
                    outputs.side[i],
                    outputs.unloaded_radius[i],
                    vehicle,
                    tire,
                )
            )
            outputs.slip_ratio[i], outputs.slip_tangent[i] = kappa, tangent


@term
def damped_slip(along, across, rolling, sliding, tread, fz, gamma, side, radius, vehicle, tire):
    """Rates of the longitudinal and lateral slip (1/s), and the slips for the Magic Formula.

    rolling, sliding: velocity of the contact point along and across the wheel (m/s). tread: spin
    times rolling radius (m/s). gamma, side: as for `held_slips`. Without load the slips decay.
    """
    if fz <= 0.0:
        return -along / RELEASE_TIME, -across / RELEASE_TIME, along, across
    long, lateral = relaxation_lengths(fz, radius, vehicle, tire)
    weight, along_released, across_released = standstill(rolling), 0.0, 0.0
    if weight > 0.0:
        along_held, across_held = held_slips(along, across, gamma, side, fz, tire)
        along_released = weight * (along - along_held)
        across_released = weight * (across - across_held)
    along_rate = slip_rate(along, rolling, tread - rolling, long, along_released)
    across_rate = slip_rate(across, rolling, sliding, lateral, across_released)
    slope = fz * tire.PKX1 * tire.LKX * radius**2  # about Kx r^2
    firm = max(DAMPING_SPEED, slope / (vehicle.wheel_inertia * QUICKEST_DAMPING))
    along += long / firm * weight * along_rate
    across += lateral / DAMPING_SPEED * weight * across_rate
    return along_rate, across_rate, along, across
