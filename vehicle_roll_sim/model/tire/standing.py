"""The slip that a tire holds at standstill: up to the peak of its own curves, at its load.

A curve D sin[C atan{B x - E (B x - atan B x)}] peaks where the argument of the sine is pi / 2, at

    y - E (y - atan y) = tan[pi / (2 C)],  y = B x.

The left side rises with y and is either convex or concave, so Newton's method approaches the
solution from one side. A curve with C up to 1 has no peak.
"""

from vehicle_roll_sim.model.compiled.elementary import arctan
from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.tire import pure_slip

LARGEST_HELD = 1.0
"""Limit of the slip ratio or slip angle (rad) held, if the curve has no peak below it."""
ITERATIONS = 8
"""Iterations of Newton's method: exact to rounding, or less than 1 % too small if E is close to
1."""


@term
def slip_at_peak(stiffness, shape, curvature):
    """|x| at the peak of a curve with these B, C and E, up to LARGEST_HELD."""
    if stiffness == 0.0 or shape <= 1.0:
        return LARGEST_HELD
    goal = math.tan(math.pi / (2 * shape))
    y = goal
    for _ in range(ITERATIONS):
        value = y - curvature * (y - arctan(y))
        y += (goal - value) / (1 - curvature + curvature / (1 + y * y))
    x = y / abs(stiffness)
    return x if x < LARGEST_HELD else LARGEST_HELD  # also if there is none: y is nan


@term
def is_below_peak(x, stiffness, shape, curvature):
    """Whether a slip is below that at the peak of its curve, without solving for the peak."""
    if shape <= 1.0 or abs(x) > LARGEST_HELD:
        return abs(x) <= LARGEST_HELD
    y = abs(stiffness * x)
    return y - curvature * (y - arctan(y)) <= math.tan(math.pi / (2 * shape))


@term
def held(parts, slip):
    """The nearest slip to `slip` that a tire holds; parts: x, B, C and E of its curve there."""
    x, stiffness, shape, curvature = parts
    if is_below_peak(x, stiffness, shape, curvature):
        return slip
    most = slip_at_peak(stiffness, shape, curvature)
    return slip - x + max(-most, min(most, x))


@kernel
def held_slips(along, across, gamma, side, fz, grip, tire):
    """The slip ratio and the tangent of the slip angle that a tire holds.

    along, across: the present ones. gamma: inclination in the axes of the tire (rad). side: -1 if
    the tire is mirrored, else 1. fz: normal load (N). grip: factor of the road on the friction.
    """
    dfz = pure_slip.relative_load(fz, tire)
    slope = pure_slip.slip_stiffness(gamma, fz, dfz, math.exp(tire.PKX3 * dfz), tire)
    peak = pure_slip.longitudinal_friction(gamma, dfz, tire) * tire.LMUX * fz * grip
    kappa = held(pure_slip.longitudinal_curve(along, dfz, slope, peak, tire), along)
    slope = pure_slip.cornering_stiffness(gamma, fz, tire)
    peak = pure_slip.lateral_friction(gamma, dfz, tire) * tire.LMUY * fz * grip
    shift = pure_slip.lateral_slip_shift(gamma, fz, dfz, pure_slip.inverse(slope), tire)
    alpha = side * arctan(across)
    curve = pure_slip.lateral_curve(alpha, gamma, dfz, shift, slope, peak, tire)
    return kappa, side * math.tan(held(curve, alpha))
