"""Forces at combined slip: terms of one wheel (Pacejka, 2012, section 4.3.2, equations 4.E50-67).

gamma: as in `pure_slip`. The shifts of the weighting functions, RHX1, RHY1 and RHY2, have no
scaling factor and always apply.
"""

from vehicle_roll_sim.model.compiled.elementary import arctan, cosine_of_arctan, sine
from vehicle_roll_sim.model.compiled.jit import term


@term
def longitudinal_weight_curve(alpha, kappa, gamma, dfz, tire):
    """x, B, half of C, and E of Gx alpha, the weighting function of Fx (E53-E57)."""
    slope = tire.RBX1
    if gamma is not None:
        inclined = tire.LGAX * gamma
        slope = (slope + tire.RBX3 * inclined * inclined) * tire.combined
    stiffness = slope * cosine_of_arctan(tire.RBX2 * kappa) * tire.LXAL
    curvature = min(tire.REX1 + tire.REX2 * dfz, 1.0)
    return alpha + tire.RHX1, stiffness, tire.RCX1 / 2, curvature


@term
def lateral_weight_curve(alpha, kappa, gamma, dfz, tire):
    """x, B, half of C, and E of Gy kappa, the weighting function of Fy (E61-E65)."""
    slope = tire.RBY1
    if gamma is not None:
        inclined = tire.LGAY * gamma
        slope = (slope + tire.RBY4 * inclined * inclined) * tire.combined
    stiffness = slope * cosine_of_arctan(tire.RBY2 * (alpha - tire.RBY3)) * tire.LYKA
    curvature = min(tire.REY1 + tire.REY2 * dfz, 1.0)
    return kappa + (tire.RHY1 + tire.RHY2 * dfz), stiffness, tire.RCY1 / 2, curvature


@term
def slip_ply_steer(kappa, alpha, gamma, dfz, peak, tire):
    """SVy kappa: lateral force induced by slip ratio (N; E66, E67)."""
    reach = tire.RVY1 + tire.RVY2 * dfz
    if gamma is not None:
        reach = (reach + tire.RVY3 * tire.LGAY * gamma) * tire.combined
    reach = peak * reach * cosine_of_arctan(tire.RVY4 * alpha)
    return reach * tire.LVYKA * sine(tire.RVY5 * arctan(tire.RVY6 * kappa))


@term
def weight(half, half_at_shift, lowest):
    """G, a ratio of cosines, from the sines of half the angles; 1 if the other slip is 0.

    A cosine becomes negative at large slip if its C is above 1, which would reverse the force;
    therefore the weight is limited to its lowest value, 0 (E51, E59).
    """
    value = (1 - 2 * half * half) / (1 - 2 * half_at_shift * half_at_shift)
    return value if value > lowest else lowest
