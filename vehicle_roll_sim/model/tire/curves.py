"""The curves sin[C atan{B x - E (B x - atan B x)}] of all wheels, and how forces read them."""

from vehicle_roll_sim.model.compiled.elementary import arctan, sine
from vehicle_roll_sim.model.compiled.jit import term
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.tire.combined_slip import weight
from vehicle_roll_sim.model.work_space import FORCE_CURVES


@term
def keep_curve(curve, i, parts, terms):
    """Store x, B, C and E of a curve of wheel i."""
    slip, stiffness, shape, curvature = parts
    place = curve * WHEEL_COUNT + i
    terms.curve_slip[place], terms.curve_stiffness[place] = slip, stiffness
    terms.curve_shape[place], terms.curve_curvature[place] = shape, curvature


@term
def keep_weight(curve, curve_at_shift, i, parts, shift, terms):
    """Store the two curves of a weighting function of wheel i. shift: its x at zero slip."""
    _, stiffness, shape, curvature = parts
    keep_curve(curve, i, parts, terms)
    keep_curve(curve_at_shift, i, (shift, stiffness, shape, curvature), terms)


@term
def sines_of_curves(count, terms):
    """The sines of the first `count` elements; those of the other curves of forces are 0.

    Their sines are computed nevertheless: a shorter loop would be unrolled, not vectorized.
    """
    for k in range(count):
        stretched = terms.curve_stiffness[k] * terms.curve_slip[k]
        excess = stretched - arctan(stretched)
        terms.curve_bend[k] = stretched - terms.curve_curvature[k] * excess
    for k in range(count):
        terms.curve_angle[k] = terms.curve_shape[k] * arctan(terms.curve_bend[k])
    for k in range(count, FORCE_CURVES * WHEEL_COUNT):
        terms.curve_angle[k] = 0.0
    for k in range(max(count, FORCE_CURVES * WHEEL_COUNT)):
        terms.curve_sine[k] = sine(terms.curve_angle[k])


@term
def sine_of(curve, i, terms):
    """The sine of a curve of wheel i."""
    return terms.curve_sine[curve * WHEEL_COUNT + i]


@term
def weight_of(curve, curve_at_shift, i, lowest, terms):
    """The weight of a force of wheel i, from the two curves of its weighting function."""
    return weight(sine_of(curve, i, terms), sine_of(curve_at_shift, i, terms), lowest)
