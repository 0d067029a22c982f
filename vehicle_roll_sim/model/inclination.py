"""Inclination (camber) of the wheels to the road, from attitude, steering and static camber."""

from vehicle_roll_sim.model.compiled.elementary import arctan_of_ratio
from vehicle_roll_sim.model.compiled.jit import kernel, math, not_unrolled, square_root
from vehicle_roll_sim.model.records import WHEEL_COUNT


@kernel
def inclinations(attitude, vehicle, tires, options, outputs):
    """gamma of every wheel (rad); 0 if nothing depends on it, to save time."""
    is_plain = tires.front.plain != 0.0 and tires.rear.plain != 0.0
    if options.contact_moments or not is_plain:
        actual_inclinations(attitude, vehicle, options, outputs)
    else:
        for i in range(WHEEL_COUNT):
            outputs.inclination[i] = 0.0


@kernel
def actual_inclinations(attitude, vehicle, options, outputs):
    """gamma of every wheel (rad), positive with the top leaning to the right, as in the W axes.

    The spin axis of a wheel that is fixed to the body and steered by delta points upwards by

        sin gamma = sin(theta) sin(delta) + cos(theta) sin(phi) cos(delta),

    to which the static camber is added. For tires kept normal to the ground, the tilt of the axle
    takes the place of the roll angle. Also sine and cosine of gamma.
    """
    if options.tire_normal_to_ground:
        leaning_wheels(True, attitude, vehicle, outputs)
    else:
        leaning_wheels(None, attitude, vehicle, outputs)


@kernel
def leaning_wheels(tilted, attitude, vehicle, outputs):
    """Inclination of every wheel. tilted: None if no axle tilts relative to the body."""
    s_roll, _, s_pitch, c_pitch = attitude
    for i in range(not_unrolled(WHEEL_COUNT)):
        lean = s_roll if tilted is None else math.sin(outputs.tire_tilt[i])
        rise = c_pitch * lean * outputs.steering_cosine[i] + s_pitch * outputs.steering_sine[i]
        rise = 1.0 if rise > 1.0 else (-1.0 if rise < -1.0 else rise)
        level = square_root((1.0 - rise) * (1.0 + rise))
        s, c = vehicle.camber_sine[i], vehicle.camber_cosine[i]
        outputs.inclination[i] = arctan_of_ratio(rise, level) + vehicle.camber[i]
        outputs.inclination_sine[i] = rise * c + level * s
        outputs.inclination_cosine[i] = level * c - rise * s
