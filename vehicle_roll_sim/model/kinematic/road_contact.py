"""A wheel of model 2 on an uneven road: the disc meets the plane under the wheel.

As in `kinematic.contact`, with the plane of the road in place of z = 0. The plane touches the road
at the point vertically below the wheel centre.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, math, square_root
from vehicle_roll_sim.model.frames import body_to_yawed, yawed_to_body
from vehicle_roll_sim.model.kinematic.contact import NEARLY_FLAT
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.road.contact import (
    in_plane,
    load_on_road,
    look_under_wheel,
    normal_of,
)
from vehicle_roll_sim.model.road.layout import SIDES
from vehicle_roll_sim.model.road.resistance import place_over_ground, side_force


@kernel
def place_on_uneven_road(state, command, heading, vehicle, attitude, ground, outputs):
    """Heading, inclination, loaded radius (m), load (N) and contact point of every wheel.

    As `place_on_road`, with the normal e and the distance of the wheel centre from the plane of the
    road. The compression of the state remains that against z = 0.
    """
    terms, plane = outputs.suspension_terms, outputs.road_terms
    for i in range(WHEEL_COUNT):
        radius = vehicle.tire_radius[i]
        outputs.unloaded_radius[i] = radius
        wheel = terms.wheel[0, i], terms.wheel[1, i], terms.wheel[2, i]
        ahead, left, up = body_to_yawed(attitude, wheel[0], wheel[1], wheel[2])
        x, y = place_over_ground(ahead, left, heading, state[at.X], state[at.Y])
        up += state[at.Z]
        look_under_wheel(i, (x, y, up), radius, heading, command, ground, outputs)
        ex, ey, ez = normal_of(i, plane)
        distance = (up - outputs.road_height[i]) * ez

        nx, ny, nz = terms.spin_axis[0, i], terms.spin_axis[1, i], terms.spin_axis[2, i]
        sx, sy, sz = body_to_yawed(attitude, nx, ny, nz)
        terms.tire_compression[i] = radius * square_root(sx * sx + sy * sy) - up
        ahead, left, rise = in_plane(i, sx, sy, sz, plane)
        cosine = max(square_root(ahead * ahead + left * left), NEARLY_FLAT)
        inverse = 1.0 / cosine
        outputs.steering_sine[i], outputs.steering_cosine[i] = -ahead * inverse, left * inverse
        level = max(square_root(sx * sx + sy * sy), NEARLY_FLAT)
        terms.lean[i] = sz / level  # of the compression against z = 0, in `compression_rates`
        outputs.inclination_sine[i], outputs.inclination_cosine[i] = rise, cosine
        outputs.inclination[i] = math.atan2(rise, cosine)

        load_on_road(i, radius - distance * inverse, vehicle, outputs)
        outputs.support[i] *= inverse
        outputs.normal_force[i] *= inverse
        loaded = radius - max(plane.deflection[i], 0.0)
        outputs.loaded_radius[i] = loaded
        reach = loaded * inverse
        bx, by, bz = yawed_to_body(attitude, ex, ey, ez)
        terms.arm[0, i] = reach * (rise * nx - bx)
        terms.arm[1, i] = reach * (rise * ny - by)
        terms.arm[2, i] = reach * (rise * nz - bz)
        plane.arm_x[i] = plane.arm_y[i] = 0.0
        plane.arm_z[i] = -loaded  # the equations of model 2 take the contact point as it is


@kernel
def motion_in_plane(state, heading, attitude, ground, outputs):
    """Turn the velocities of the contact points into the plane of the road; forces on the sides.

    After `contact_motion`, which leaves out the vertical velocity.
    """
    terms, plane = outputs.suspension_terms, outputs.road_terms
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    wu = state[at.UNSPRUNG_VELOCITY]
    for i in range(WHEEL_COUNT):
        x, y, z = terms.arm[0, i], terms.arm[1, i], terms.arm[2, i]
        rate = outputs.suspension_rate[i]
        px, py = terms.contact_path[0, i] - terms.path[0, i], terms.contact_path[1, i]
        py, pz = py - terms.path[1, i], terms.contact_path[2, i] - 1.0
        ahead = outputs.unsprung_u[i] + wy * z - wz * y + px * rate
        left = outputs.unsprung_v[i] + wz * x - wx * z + py * rate
        up = wu[i] + wx * y - wy * x + pz * rate
        ug, vg, wg = body_to_yawed(attitude, ahead, left, up)
        outputs.contact_u[i], outputs.contact_v[i], _ = in_plane(i, ug, vg, wg, plane)
        if ground[SIDES] == 0.0:
            continue
        wheel = terms.wheel[0, i], terms.wheel[1, i], terms.wheel[2, i]
        ahead, left, _ = body_to_yawed(attitude, wheel[0], wheel[1], wheel[2])
        x, y = place_over_ground(ahead, left, heading, state[at.X], state[at.Y])
        side_force(i, x, y, ug, vg, heading, ground, outputs)
