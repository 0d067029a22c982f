"""Struts in detail: springs and dampers with any characteristic, bump and rebound stops.

All forces are those on the wheel, over its own travel.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, term
from vehicle_roll_sim.model.kinematic.guidance import interval
from vehicle_roll_sim.model.records import FRONT, LR, REAR, WHEEL_COUNT


@kernel
def value_at(x, knots, origins, pieces):
    """The value at x of a curve made of polynomials of fifth degree."""
    row = interval(x, knots)
    d, p = x - origins[row], pieces[row]
    return p[0] + d * (p[1] + d * (p[2] + d * (p[3] + d * (p[4] + d * p[5]))))


@term
def stop_force(compression, stiffness, progression):
    """Force of a stop (N): k d + p d^2 / 2 at its compression d (m), 0 without contact."""
    if compression <= 0.0:
        return 0.0
    return compression * (stiffness + compression * progression / 2)


@kernel
def detailed_strut_forces(state, command, vehicle, outputs):
    """Fzs of every corner (N; in place of eq. 23): spring and damper, their curves over compression
    and its rate; stops; anti-roll bar; active normal force."""
    details, xs = vehicle.details, state[at.SUSPENSION_COMPRESSION]
    for i in range(WHEEL_COUNT):
        axle, other = FRONT if i < LR else REAR, i + 1 if i % 2 == 0 else i - 1
        travel = xs[i] - vehicle.static_suspension_compression[i]
        force = value_at(
            xs[i], details.spring_knots[axle], details.spring_origins[axle], details.spring[axle]
        )
        force += value_at(
            outputs.suspension_rate[i],
            details.damper_knots[axle],
            details.damper_origins[axle],
            details.damper[axle],
        )
        force += stop_force(
            travel - details.bump_stop_clearance[i],
            details.bump_stop_stiffness[i],
            details.bump_stop_progression[i],
        )
        force -= stop_force(
            -travel - details.rebound_stop_clearance[i],
            details.rebound_stop_stiffness[i],
            details.rebound_stop_progression[i],
        )
        force += vehicle.bar_rate[i] * (xs[i] - xs[other])
        outputs.strut_force[i] = force + command.normal_force[i]
