"""Moments at the contact point: those of the tire, and those due to the contact-patch shift.

Tire moments are about the W axes of a wheel (x along it in the road plane, y to the left, z normal
to the road), like the tire forces. Under a lateral force the contact patch of a tire shifts
sideways relative to its rim, by y = Fy / cy with the lateral stiffness cy. The forces then act off
the nominal contact point, with the moments y Fz about the x axis and -y Fx about the z axis.
"""

from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.frames import yawed_to_body
from vehicle_roll_sim.model.records import WHEEL_COUNT


@kernel
def contact_moments(attitude, vehicle, outputs):
    """Add the moments due to the shift to those of the tires (N m), and express them in frame 1.

    They are rotated by the steering angle into frame 2, as the tire forces are (eqs 3, 4), and from
    there into frame 1 as in equation 2. Also their component about the spin axis, which is the y
    axis of the W axes, inclined by gamma.
    """
    for i in range(WHEEL_COUNT):
        shift = vehicle.tire_lateral_compliance[i] * outputs.tire_lateral[i]
        outputs.overturning_moment[i] += shift * outputs.normal_force[i]
        outputs.aligning_moment[i] -= shift * outputs.tire_longitudinal[i]
        x, y = outputs.overturning_moment[i], outputs.rolling_resistance_moment[i]
        s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
        ahead, left, up = x * c - y * s, y * c + x * s, outputs.aligning_moment[i]
        about_x, about_y, about_z = yawed_to_body(attitude, ahead, left, up)
        outputs.contact_moment_x[i] = about_x
        outputs.contact_moment_y[i], outputs.contact_moment_z[i] = about_y, about_z
        turning = outputs.rolling_resistance_moment[i] * outputs.inclination_cosine[i]
        turning += outputs.aligning_moment[i] * outputs.inclination_sine[i]
        outputs.spin_moment[i] = turning
