"""Struts in detail: springs and dampers with any characteristic, bump and rebound stops.

The force of a spring or damper on a wheel is its own force times its motion ratio, the change of
its compression with the travel of the wheel (virtual work). Stops and anti-roll bars act on the
wheel, over its own travel.
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


@kernel
def value_and_slope(x, knots, origins, pieces):
    """The value at x of such a curve, and its slope."""
    row = interval(x, knots)
    d, p = x - origins[row], pieces[row]
    value = p[0] + d * (p[1] + d * (p[2] + d * (p[3] + d * (p[4] + d * p[5]))))
    return value, p[1] + d * (2 * p[2] + d * (3 * p[3] + d * (4 * p[4] + d * (5 * p[5]))))


@kernel
def spring_force(i, travel, details):
    """Force of a spring on wheel i (N) at its travel (m)."""
    axle = FRONT if i < LR else REAR
    compressed, ratio = value_and_slope(
        travel,
        details.spring_travel_knots[axle],
        details.spring_travel_origins[axle],
        details.spring_travel[axle],
    )
    compression = details.spring_compression_at_rest[i] + compressed
    knots, origins = details.spring_knots[axle], details.spring_origins[axle]
    return ratio * value_at(compression, knots, origins, details.spring[axle])


@kernel
def damper_force(i, travel, rate, details):
    """Force of a damper on wheel i (N) at its travel (m) and the rate of it (m/s)."""
    axle = FRONT if i < LR else REAR
    _, ratio = value_and_slope(
        travel,
        details.damper_travel_knots[axle],
        details.damper_travel_origins[axle],
        details.damper_travel[axle],
    )
    knots, origins = details.damper_knots[axle], details.damper_origins[axle]
    return ratio * value_at(ratio * rate, knots, origins, details.damper[axle])


@term
def stop_force(compression, stiffness, progression):
    """Force of a stop (N): k d + p d^2 / 2 at its compression d (m), 0 without contact."""
    if compression <= 0.0:
        return 0.0
    return compression * (stiffness + compression * progression / 2)


@term
def apart_from_rest(i, state, vehicle):
    """How far the travel of wheel i exceeds that of the other wheel of its axle (m).

    0 at rest, even if the c.g. is off the centreline and the springs are compressed unequally.
    """
    other = i + 1 if i % 2 == 0 else i - 1
    xs, at_rest = state[at.SUSPENSION_COMPRESSION], vehicle.static_suspension_compression
    return (xs[i] - xs[other]) - (at_rest[i] - at_rest[other])


@kernel
def detailed_strut_forces(state, command, vehicle, outputs):
    """Fzs of every corner (N; in place of eq. 23): spring, damper, stops, anti-roll bar, active
    normal force."""
    details, xs = vehicle.details, state[at.SUSPENSION_COMPRESSION]
    for i in range(WHEEL_COUNT):
        travel = xs[i] - vehicle.static_suspension_compression[i]
        force = spring_force(i, travel, details)
        force += damper_force(i, travel, outputs.suspension_rate[i], details)
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
        force += vehicle.bar_rate[i] * apart_from_rest(i, state, vehicle)
        outputs.strut_force[i] = force + command.normal_force[i]
