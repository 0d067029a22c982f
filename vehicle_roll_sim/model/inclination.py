"""Inclination of the wheels to the road (camber), from attitude, steering and static camber."""

from vehicle_roll_sim.model.compiled.elementary import arctan
from vehicle_roll_sim.model.compiled.jit import kernel, math, square_root, term
from vehicle_roll_sim.model.records import FRONT, REAR, WHEEL_COUNT

NEARLY_FLAT = 1e-300
"""Lower limit of the squared cosine of an inclination; keeps its tangent finite at 90 degrees."""


@term
def arcsine(x):
    """asin x (rad) for |x| up to 1."""
    return arctan(x / square_root(max((1.0 - x) * (1.0 + x), NEARLY_FLAT)))


@kernel
def inclinations(attitude, vehicle, tires, options, outputs):
    """gamma of every wheel (rad), or 0 if nothing depends on it, which saves time."""
    is_plain = tires[FRONT].plain != 0.0 and tires[REAR].plain != 0.0
    if options.contact_moments or not is_plain:
        actual_inclinations(attitude, vehicle, options, outputs)
    else:
        for i in range(WHEEL_COUNT):
            outputs.inclination[i] = 0.0


@kernel
def actual_inclinations(attitude, vehicle, options, outputs):
    """gamma of every wheel (rad), positive with its top towards the right, as in the W axes.

    The spin axis of a wheel that is fixed to the body and steered by delta points upwards by

        sin gamma = sin(theta) sin(delta) + cos(theta) sin(phi) cos(delta),

    and its static camber is added. A tire that is kept normal to the ground has the tilt of its
    axle in place of the roll angle.
    """
    s_roll, _, s_pitch, c_pitch = attitude
    for i in range(WHEEL_COUNT):
        lean = math.sin(outputs.tire_tilt[i]) if options.tire_normal_to_ground else s_roll
        rise = s_pitch * outputs.steering_sine[i] + c_pitch * lean * outputs.steering_cosine[i]
        outputs.inclination[i] = max(-1.0, min(1.0, rise))
    for i in range(WHEEL_COUNT):
        outputs.inclination[i] = arcsine(outputs.inclination[i])
    for i in range(WHEEL_COUNT):
        outputs.inclination[i] += vehicle.camber[i]
