"""A wheel of model 1 on an uneven road: contact in the plane under the wheel (not in the paper).

The plane touches the road at the point vertically below the wheel centre. On the plane z = 0
everything equals equations 7, 8 and 13 to 16. The tire compression of the state is that against
z = 0; the height h of the road is added here, so that the rate of equation 14 is that of the wheel
alone, and wg, the rate of h, acts without being integrated: a step of the road is exact.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.elementary import arctan_of_ratio
from vehicle_roll_sim.model.compiled.jit import kernel, not_unrolled, square_root, term
from vehicle_roll_sim.model.contact import normal_force, small_angle_contact_velocity
from vehicle_roll_sim.model.fallen_wheels import as_disc, held_radius, lightened, share_of_load
from vehicle_roll_sim.model.frames import (
    body_to_yawed,
    ground_to_yawed,
    yawed_to_body,
    yawed_to_ground,
)
from vehicle_roll_sim.model.records import LF, LR, WHEEL_COUNT
from vehicle_roll_sim.model.road.layout import SIDES
from vehicle_roll_sim.model.road.plane import planes_under_wheels
from vehicle_roll_sim.model.road.plane_axes import from_plane, in_plane, normal_of
from vehicle_roll_sim.model.road.resistance import side_forces
from vehicle_roll_sim.model.road.surface import place_wheel, softness
from vehicle_roll_sim.model.tire.spring import spring_force

MOST_INCLINED = 0.1
"""Lower limit of the cosine between the body's z axis and the normal of the road."""


@kernel
def normal_friction(outputs):
    """The friction of a road without features: as the tire file has it."""
    for i in range(WHEEL_COUNT):
        outputs.road_friction[i] = 1.0


@kernel
def look_under_wheels(heading, command, vehicle, ground, outputs):
    """Height (m) and slope of the plane under every wheel, its normal, and the friction there.

    The slope is along the axes of frame 2. Also how far tire and soil would be compressed by an
    upright wheel.
    """
    terms = outputs.road_terms
    planes_under_wheels(vehicle, ground, terms)
    for i in range(not_unrolled(WHEEL_COUNT)):
        height = terms.height[i] + command.road_height[i]
        friction = terms.friction[i] * (1.0 + command.road_friction_change[i])
        a, b = ground_to_yawed(heading, terms.slope_x[i], terms.slope_y[i])
        z, radius = terms.place_z[i], vehicle.tire_radius[i]
        along, whole = square_root(1.0 + a * a), square_root(1.0 + a * a + b * b)
        inverse = 1.0 / (along * whole)  # one division for both
        level, upright = inverse * whole, inverse * along
        outputs.road_height[i], outputs.road_friction[i] = height, friction
        terms.along[i], terms.across[i], terms.level[i] = a, b, level
        terms.normal_x[i], terms.normal_y[i] = -a * upright, -b * upright
        terms.normal_z[i] = upright
        terms.deflection[i] = radius - (z - height) * upright
        terms.sinkage[i] = terms.side_x[i] = terms.side_y[i] = terms.side_height[i] = 0.0


@term
def deflection_on_soil(compression, soft, progression):
    """Part of a compression (m) that the tire has; the soil yields by the rest.

    soft: stiffness of the tire over that of the soil.
    """
    if compression <= 0.0 or soft == 0.0:
        return compression
    root = square_root((1.0 + soft) ** 2 + 4.0 * soft * progression * compression)
    return 2.0 * compression / (1.0 + soft + root)


@kernel
def lean(attitude, vehicle, terms):
    """Replace the compression of every wheel, `deflection`, by that of a tire that leans."""
    for i in range(WHEEL_COUNT):
        nx, ny, nz = normal_of(i, terms)
        _, _, bz = yawed_to_body(attitude, nx, ny, nz)
        terms.deflection[i] = as_disc(terms.deflection[i], vehicle.tire_radius[i], bz)


@kernel
def lighten_sides(attitude, terms):
    """Scale the forces on the sides of wheels by the share of their loads that remains."""
    for i in range(WHEEL_COUNT):
        nx, ny, nz = normal_of(i, terms)
        _, _, bz = yawed_to_body(attitude, nx, ny, nz)
        terms.side_x[i] *= share_of_load(bz)
        terms.side_y[i] *= share_of_load(bz)


@kernel
def sink(vehicle, ground, terms):
    """Divide the compression of every wheel, `deflection`, between tire and soft soil."""
    for i in range(WHEEL_COUNT):
        yielding, linear, quadratic = softness(terms.place_x[i], terms.place_y[i], ground)
        terms.linear[i], terms.quadratic[i] = linear, quadratic
        stiffness, progression = vehicle.tire_stiffness[i], vehicle.tire_progression[i]
        compression = terms.deflection[i]
        deflection = deflection_on_soil(compression, stiffness * yielding, progression)
        terms.deflection[i] = deflection
        terms.sinkage[i] = max(compression - deflection, 0.0)


@kernel
def places_over_ground(state, heading, vehicle, attitude, outputs):
    """Where every wheel centre is in the ground frame (m); its height is that of the strut."""
    terms = outputs.road_terms
    x0, y0, xt = state[at.X], state[at.Y], state[at.TIRE_COMPRESSION]
    for i in range(not_unrolled(WHEEL_COUNT)):
        x, y, below = vehicle.x[i], vehicle.y[i], -outputs.strut_length[i]
        ahead, left, _ = body_to_yawed(attitude, x, y, below)
        along, across = yawed_to_ground(heading, ahead, left)
        place_wheel(i, x0 + along, y0 + across, vehicle.tire_radius[i] - xt[i], terms)


@kernel
def contact_on_road(state, command, heading, vehicle, options, attitude, ground, outputs):
    """Normal load (N), loaded radius (m) and contact velocity in the plane of the road (m/s).

    The contact point is the loaded radius along the body's z axis below the wheel centre, as in the
    paper, but rotated about the spin axis of the wheel by the slope of the road along it. Without
    pitch, a normal force has no moment about this axis, neither on the wheel nor, through it, on
    the body; with pitch it has the lever of the paper, r sin(pitch).
    """
    terms, wu = outputs.road_terms, state[at.UNSPRUNG_VELOCITY]
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    places_over_ground(state, heading, vehicle, attitude, outputs)
    look_under_wheels(heading, command, vehicle, ground, outputs)
    if options.body_contact:
        lean(attitude, vehicle, terms)
    if ground[SIDES] != 0.0:
        sink(vehicle, ground, terms)
    for i in range(not_unrolled(WHEEL_COUNT)):
        nx, ny, nz = normal_of(i, terms)
        s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
        radius, deflection = vehicle.tire_radius[i], terms.deflection[i]
        stiffness, progression = vehicle.tire_stiffness[i], vehicle.tire_progression[i]
        uu, vu, up = outputs.unsprung_u[i], outputs.unsprung_v[i], wu[i]
        support = spring_force(deflection, stiffness, progression)  # (13)
        rise = -(nx * c + ny * s)  # sine of the slope along the wheel
        level = square_root(max(1.0 - rise * rise, 0.0))
        bx, by, bz = yawed_to_body(attitude, nx, ny, nz)
        cosine = max(level * bz - rise * (c * bx + s * by), MOST_INCLINED)
        r = radius - max(deflection, 0.0) / cosine  # (15)
        if options.body_contact:
            r = held_radius(deflection, radius, cosine)
            support = lightened(support, share_of_load(bz))
        ax, ay, az = r * rise * c, r * rise * s, -r * level
        uu, vu, up = uu + wy * az - wz * ay, vu + wz * ax - wx * az, up + wx * ay - wy * ax
        ug, vg, wg = body_to_yawed(attitude, uu, vu, up)
        ahead, left, _ = in_plane(i, ug, vg, wg, terms)
        outputs.support[i], outputs.normal_force[i] = support, normal_force(support)
        outputs.loaded_radius[i], outputs.contact_u[i], outputs.contact_v[i] = r, ahead, left
        terms.arm_x[i], terms.arm_y[i], terms.arm_z[i] = ax, ay, az
        terms.speed_ahead[i], terms.speed_left[i], terms.speed_up[i] = ug, vg, wg
    if options.small_angles:
        small_angle_velocities(wx, wy, vehicle, options, outputs)
    if ground[SIDES] != 0.0:
        side_forces(heading, ground, outputs)
        if options.body_contact:
            lighten_sides(attitude, terms)


@kernel
def small_angle_velocities(wx, wy, vehicle, options, outputs):
    """Contact velocities of the models for small angles (m/s)."""
    terms = outputs.road_terms
    for i in range(WHEEL_COUNT):
        ug, vg = small_angle_contact_velocity(i, wx, wy, vehicle, options, outputs)
        terms.speed_ahead[i], terms.speed_left[i] = ug, vg
        ahead, left, _ = in_plane(i, ug, vg, terms.speed_up[i], terms)
        outputs.contact_u[i], outputs.contact_v[i] = ahead, left


@kernel
def inclinations_on_road(attitude, vehicle, tires, outputs):
    """Inclination of every wheel to the plane of the road, as `actual_inclinations` to z = 0.

    0 if nothing depends on it, to save time.
    """
    is_plain = tires.front.plain != 0.0 and tires.rear.plain != 0.0
    shifts = vehicle.tire_lateral_compliance[LF] + vehicle.tire_lateral_compliance[LR]
    if is_plain and shifts == 0.0:
        for i in range(WHEEL_COUNT):
            outputs.inclination[i] = outputs.inclination_sine[i] = 0.0
            outputs.inclination_cosine[i] = 1.0
        return
    for i in range(not_unrolled(WHEEL_COUNT)):
        nx, ny, nz = normal_of(i, outputs.road_terms)
        s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
        ahead, left, up = body_to_yawed(attitude, -s, c, 0.0)
        rise = max(-1.0, min(1.0, nx * ahead + ny * left + nz * up))
        level = square_root((1.0 - rise) * (1.0 + rise))
        s, c = vehicle.camber_sine[i], vehicle.camber_cosine[i]
        outputs.inclination[i] = arctan_of_ratio(rise, level) + vehicle.camber[i]
        outputs.inclination_sine[i] = rise * c + level * s
        outputs.inclination_cosine[i] = level * c - rise * s


@kernel
def contact_moments_on_road(attitude, vehicle, outputs):
    """Moments at the contact points in frame 1 (N m), as `contact_moments` in the plane z = 0.

    Also those of the forces on the side of the wheels, and those of all forces about the point from
    which the equations of motion count them, on the body's z axis.
    """
    terms = outputs.road_terms
    for i in range(not_unrolled(WHEEL_COUNT)):
        shift = vehicle.tire_lateral_compliance[i] * outputs.tire_lateral[i]
        mx = outputs.overturning_moment[i] + shift * outputs.normal_force[i]
        my = outputs.rolling_resistance_moment[i]
        mz = outputs.aligning_moment[i] - shift * outputs.tire_longitudinal[i]
        s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
        inclined, upright = outputs.inclination_sine[i], outputs.inclination_cosine[i]
        x, y, z = from_plane(i, mx * c - my * s, my * c + mx * s, mz, terms)
        arm, side_x, side_y = terms.side_height[i], terms.side_x[i], terms.side_y[i]
        x, y, z = yawed_to_body(attitude, x - arm * side_y, y + arm * side_x, z)
        fx, fy = outputs.longitudinal_force[i], outputs.lateral_force[i]
        fx, fy, fz = from_plane(i, fx, fy, outputs.normal_force[i], terms)
        fx, fy = fx + side_x, fy + side_y
        bx, by, bz = yawed_to_body(attitude, fx, fy, fz)
        ax, ay, az = terms.arm_x[i], terms.arm_y[i], terms.arm_z[i] + outputs.loaded_radius[i]
        outputs.overturning_moment[i], outputs.aligning_moment[i] = mx, mz
        terms.force_x[i], terms.force_y[i], terms.force_z[i] = fx, fy, fz
        outputs.contact_moment_x[i] = x + ay * bz - az * by
        outputs.contact_moment_y[i] = y + az * bx - ax * bz
        outputs.contact_moment_z[i] = z + ax * by - ay * bx
        outputs.spin_moment[i] = my * upright + mz * inclined


@kernel
def turn_forces_to_level(outputs):
    """Replace the contact forces in the plane of the road by the whole force in frame 2 (N).

    After `contact_moments_on_road`, which finds it.
    """
    terms = outputs.road_terms
    for i in range(WHEEL_COUNT):
        outputs.longitudinal_force[i] = terms.force_x[i]
        outputs.lateral_force[i], outputs.normal_force[i] = terms.force_y[i], terms.force_z[i]
