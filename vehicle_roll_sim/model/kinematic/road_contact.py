"""A wheel of model 2 on an uneven road: the disc meets the plane under the wheel.

As in `kinematic.contact`, with the plane of the road in place of z = 0. The plane touches the road
at the point vertically below the wheel centre.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.elementary import arctan_of_ratio
from vehicle_roll_sim.model.compiled.jit import kernel, not_unrolled, square_root
from vehicle_roll_sim.model.contact import normal_force
from vehicle_roll_sim.model.frames import body_to_yawed, yawed_to_body, yawed_to_ground
from vehicle_roll_sim.model.kinematic.contact import NEARLY_FLAT
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.road.contact import look_under_wheels, sink
from vehicle_roll_sim.model.road.layout import SIDES
from vehicle_roll_sim.model.road.plane_axes import in_plane, normal_of
from vehicle_roll_sim.model.road.resistance import side_forces
from vehicle_roll_sim.model.road.surface import place_wheel
from vehicle_roll_sim.model.tire.spring import spring_force


@kernel
def place_on_uneven_road(state, command, heading, vehicle, attitude, ground, outputs):
    """Heading, inclination, loaded radius (m), load (N) and contact point of every wheel.

    As `place_on_road`, with the normal e and the distance of the wheel centre from the plane of the
    road. The compression of the state remains that against z = 0.
    """
    terms, plane = outputs.suspension_terms, outputs.road_terms
    x0, y0, z0 = state[at.X], state[at.Y], state[at.Z]
    for i in range(not_unrolled(WHEEL_COUNT)):
        x, y, z = terms.wheel[0, i], terms.wheel[1, i], terms.wheel[2, i]
        ahead, left, up = body_to_yawed(attitude, x, y, z)
        along, across = yawed_to_ground(heading, ahead, left)
        place_wheel(i, x0 + along, y0 + across, z0 + up, plane)
    look_under_wheels(heading, command, vehicle, ground, outputs)
    incline_on_road(vehicle, attitude, outputs)
    if ground[SIDES] != 0.0:
        sink(vehicle, ground, plane)
    for i in range(not_unrolled(WHEEL_COUNT)):
        inverse, rise = 1.0 / outputs.inclination_cosine[i], outputs.inclination_sine[i]
        deflection = plane.deflection[i]
        stiffness, progression = vehicle.tire_stiffness[i], vehicle.tire_progression[i]
        support = spring_force(deflection, stiffness, progression) * inverse
        loaded = vehicle.tire_radius[i] - max(deflection, 0.0)
        reach = loaded * inverse
        nx, ny, nz = terms.spin_axis[0, i], terms.spin_axis[1, i], terms.spin_axis[2, i]
        ex, ey, ez = normal_of(i, plane)
        bx, by, bz = yawed_to_body(attitude, ex, ey, ez)
        outputs.support[i], outputs.normal_force[i] = support, normal_force(support)
        outputs.loaded_radius[i] = loaded
        terms.arm[0, i] = reach * (rise * nx - bx)
        terms.arm[1, i] = reach * (rise * ny - by)
        terms.arm[2, i] = reach * (rise * nz - bz)
        plane.arm_x[i] = plane.arm_y[i] = 0.0
        plane.arm_z[i] = -loaded  # the equations of model 2 take the contact point as it is


@kernel
def incline_on_road(vehicle, attitude, outputs):
    """Heading and inclination of every wheel in the plane of the road, and its compression there.

    Also the compression against z = 0, and the slope of the spin axis, from which its rate follows.
    """
    terms, plane = outputs.suspension_terms, outputs.road_terms
    for i in range(not_unrolled(WHEEL_COUNT)):
        radius, up = vehicle.tire_radius[i], plane.place_z[i]
        nx, ny, nz = terms.spin_axis[0, i], terms.spin_axis[1, i], terms.spin_axis[2, i]
        distance = (up - outputs.road_height[i]) * plane.normal_z[i]
        sx, sy, sz = body_to_yawed(attitude, nx, ny, nz)
        ahead, left, rise = in_plane(i, sx, sy, sz, plane)
        cosine = max(square_root(ahead * ahead + left * left), NEARLY_FLAT)
        inverse, level = 1.0 / cosine, square_root(sx * sx + sy * sy)
        terms.tire_compression[i] = radius * level - up
        terms.lean[i] = sz / max(level, NEARLY_FLAT)
        outputs.unloaded_radius[i] = radius
        outputs.steering_sine[i], outputs.steering_cosine[i] = -ahead * inverse, left * inverse
        outputs.inclination_sine[i], outputs.inclination_cosine[i] = rise, cosine
        plane.deflection[i] = radius - distance * inverse
    for i in range(not_unrolled(WHEEL_COUNT)):
        rise, cosine = outputs.inclination_sine[i], outputs.inclination_cosine[i]
        outputs.inclination[i] = arctan_of_ratio(rise, cosine)


@kernel
def motion_in_plane(state, heading, attitude, ground, outputs):
    """Turn the velocities of the contact points into the plane of the road; forces on the sides.

    After `contact_motion`, which leaves out the vertical velocity.
    """
    terms, plane = outputs.suspension_terms, outputs.road_terms
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    wu = state[at.UNSPRUNG_VELOCITY]
    for i in range(not_unrolled(WHEEL_COUNT)):
        x, y, z = terms.arm[0, i], terms.arm[1, i], terms.arm[2, i]
        rate = outputs.suspension_rate[i]
        px, py = terms.contact_path[0, i] - terms.path[0, i], terms.contact_path[1, i]
        py, pz = py - terms.path[1, i], terms.contact_path[2, i] - 1.0
        ahead = outputs.unsprung_u[i] + wy * z - wz * y + px * rate
        left = outputs.unsprung_v[i] + wz * x - wx * z + py * rate
        up = wu[i] + wx * y - wy * x + pz * rate
        ug, vg, wg = body_to_yawed(attitude, ahead, left, up)
        plane.speed_ahead[i], plane.speed_left[i] = ug, vg
        outputs.contact_u[i], outputs.contact_v[i], _ = in_plane(i, ug, vg, wg, plane)
    if ground[SIDES] != 0.0:
        side_forces(heading, ground, outputs)
