"""Inclination (camber) of the wheels to the road, from attitude, steering and static camber."""

from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.records import FRONT, REAR, WHEEL_COUNT


@kernel
def inclinations(attitude, vehicle, tires, options, outputs):
    """gamma of every wheel (rad); 0 if nothing depends on it, to save time."""
    is_plain = tires[FRONT].plain != 0.0 and tires[REAR].plain != 0.0
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
    takes the place of the roll angle.
    """
    s_roll, _, s_pitch, c_pitch = attitude
    for i in range(WHEEL_COUNT):
        lean = math.sin(outputs.tire_tilt[i]) if options.tire_normal_to_ground else s_roll
        rise = s_pitch * outputs.steering_sine[i] + c_pitch * lean * outputs.steering_cosine[i]
        rise = 1.0 if rise > 1.0 else (-1.0 if rise < -1.0 else rise)
        outputs.inclination[i] = math.asin(rise) + vehicle.camber[i]
