"""A wheel of model 1 on an uneven road: contact in the plane under the wheel (not in the paper).

The plane touches the road at the point vertically below the wheel centre. On the plane z = 0
everything equals equations 7, 8 and 13 to 16. The tire compression of the state is that against
z = 0; the height h of the road is added here, so that the rate of equation 14 is that of the wheel
alone, and wg, the rate of h, acts without being integrated: a step of the road is exact.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, math, square_root, term
from vehicle_roll_sim.model.contact import normal_force, small_angle_contact_velocity
from vehicle_roll_sim.model.fallen_wheels import as_disc, held_radius, lighten, share_of_load
from vehicle_roll_sim.model.frames import body_to_yawed, ground_to_yawed, yawed_to_body
from vehicle_roll_sim.model.records import LF, LR, WHEEL_COUNT
from vehicle_roll_sim.model.road.layout import SIDES
from vehicle_roll_sim.model.road.plane import plane_under
from vehicle_roll_sim.model.road.resistance import place_over_ground, side_force
from vehicle_roll_sim.model.road.surface import softness
from vehicle_roll_sim.model.tire.spring import spring_force

MOST_INCLINED = 0.1
"""Lower limit of the cosine between the body's z axis and the normal of the road."""


@kernel
def normal_friction(outputs):
    """The friction of a road without features: as the tire file has it."""
    for i in range(WHEEL_COUNT):
        outputs.road_friction[i] = 1.0


@kernel
def look_under_wheel(i, place, radius, heading, command, ground, outputs):
    """Height (m) and slope of the plane under wheel i, friction and softness.

    place: of the wheel centre in the ground frame (m). The slope is along the axes of frame 2.
    """
    terms, x, y = outputs.road_terms, place[0], place[1]
    height, along, across, friction = plane_under(place, radius, ground)
    outputs.road_height[i] = height + command.road_height[i]
    outputs.road_friction[i] = friction * (1.0 + command.road_friction_change[i])
    terms.along[i], terms.across[i] = ground_to_yawed(heading, along, across)
    a, b = terms.along[i], terms.across[i]
    terms.level[i] = 1.0 / square_root(1.0 + a * a)
    upright = 1.0 / square_root(1.0 + a * a + b * b)
    terms.normal_x[i], terms.normal_y[i], terms.normal_z[i] = -a * upright, -b * upright, upright
    terms.yielding[i] = terms.side_x[i] = terms.side_y[i] = terms.side_height[i] = 0.0
    if ground[SIDES] != 0.0:
        terms.yielding[i], terms.linear[i], terms.quadratic[i] = softness(x, y, ground)


@term
def normal_of(i, terms):
    """The normal of the road at wheel i in frame 2."""
    return terms.normal_x[i], terms.normal_y[i], terms.normal_z[i]


@term
def in_plane(i, x, y, z, terms):
    """Components of a vector of frame 2 along the axes of the plane of the road at wheel i.

    Forward along the plane in the direction of the x axis, to the left in the plane, and along the
    normal.
    """
    a, b = terms.along[i], terms.across[i]
    nx, ny, nz = normal_of(i, terms)
    level = terms.level[i]
    ahead = level * (x + a * z)
    left = level * nz * ((1.0 + a * a) * y + b * z - a * b * x)
    return ahead, left, nx * x + ny * y + nz * z


@term
def from_plane(i, ahead, left, up, terms):
    """The vector in frame 2 from its components of `in_plane`."""
    a, b = terms.along[i], terms.across[i]
    nx, ny, nz = normal_of(i, terms)
    level = terms.level[i]
    aside = left * level * nz
    x = ahead * level - aside * a * b + up * nx
    return x, aside * (1.0 + a * a) + up * ny, a * ahead * level + aside * b + up * nz


@term
def deflection_on_soil(i, compression, stiffness, progression, terms):
    """Part of a compression (m) that the tire has; the soil yields by the rest."""
    soft = stiffness * terms.yielding[i]
    if compression <= 0.0 or soft == 0.0:
        return compression
    root = square_root((1.0 + soft) ** 2 + 4.0 * soft * progression * compression)
    return 2.0 * compression / (1.0 + soft + root)


@kernel
def load_on_road(i, compression, vehicle, outputs):
    """Load (N) at a compression of tire and soil normal to the road (m), and both parts of it."""
    terms = outputs.road_terms
    stiffness, progression = vehicle.tire_stiffness[i], vehicle.tire_progression[i]
    deflection = deflection_on_soil(i, compression, stiffness, progression, terms)
    terms.deflection[i] = deflection
    terms.sinkage[i] = max(compression - deflection, 0.0)
    outputs.support[i] = spring_force(deflection, stiffness, progression)
    outputs.normal_force[i] = normal_force(outputs.support[i])


@kernel
def contact_on_road(state, command, heading, vehicle, options, attitude, ground, outputs):
    """Normal load (N), loaded radius (m) and contact velocity in the plane of the road (m/s).

    The contact point is the loaded radius along the body's z axis below the wheel centre, as in the
    paper, but turned about the axis of the wheel by the slope of the road along it: a normal force
    turns neither the wheel nor, through it, the body.
    """
    terms = outputs.road_terms
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    xt, wu = state[at.TIRE_COMPRESSION], state[at.UNSPRUNG_VELOCITY]
    for i in range(WHEEL_COUNT):
        ls, radius = outputs.strut_length[i], vehicle.tire_radius[i]
        ahead, left, _ = body_to_yawed(attitude, vehicle.x[i], vehicle.y[i], -ls)
        x, y = place_over_ground(ahead, left, heading, state[at.X], state[at.Y])
        place = (x, y, radius - xt[i])
        look_under_wheel(i, place, radius, heading, command, ground, outputs)
        nx, ny, nz = normal_of(i, terms)
        compression = (xt[i] + outputs.road_height[i]) * nz + radius * (1.0 - nz)
        bx, by, bz = yawed_to_body(attitude, nx, ny, nz)
        if options.body_contact:
            compression = as_disc(compression, radius, bz)
        load_on_road(i, compression, vehicle, outputs)

        s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
        rise = -(nx * c + ny * s)  # sine of the slope along the wheel
        level = square_root(max(1.0 - rise * rise, 0.0))
        cosine = max(level * bz - rise * (c * bx + s * by), MOST_INCLINED)
        r = radius - max(terms.deflection[i], 0.0) / cosine  # (15)
        if options.body_contact:
            r = held_radius(terms.deflection[i], radius, cosine)
            lighten(i, share_of_load(bz), outputs)
        outputs.loaded_radius[i] = r
        ax, ay, az = r * rise * c, r * rise * s, -r * level
        terms.arm_x[i], terms.arm_y[i], terms.arm_z[i] = ax, ay, az

        uu, vu = outputs.unsprung_u[i] + wy * az - wz * ay, outputs.unsprung_v[i] + wz * ax
        vu, up = vu - wx * az, wu[i] + wx * ay - wy * ax
        ug, vg, wg = body_to_yawed(attitude, uu, vu, up)
        if options.small_angles:
            ug, vg = small_angle_contact_velocity(i, wx, wy, vehicle, options, outputs)
        outputs.contact_u[i], outputs.contact_v[i], _ = in_plane(i, ug, vg, wg, terms)
        if ground[SIDES] != 0.0:
            side_force(i, x, y, ug, vg, heading, ground, outputs)
            if options.body_contact:
                terms.side_x[i] *= share_of_load(bz)
                terms.side_y[i] *= share_of_load(bz)


@kernel
def inclinations_on_road(attitude, vehicle, tires, outputs):
    """Inclination of every wheel to the plane of the road, as `actual_inclinations` to z = 0.

    0 if nothing depends on it, to save time.
    """
    is_plain = tires.front.plain != 0.0 and tires.rear.plain != 0.0
    shifts = vehicle.tire_lateral_compliance[LF] + vehicle.tire_lateral_compliance[LR]
    for i in range(WHEEL_COUNT):
        if is_plain and shifts == 0.0:
            outputs.inclination[i] = outputs.inclination_sine[i] = 0.0
            outputs.inclination_cosine[i] = 1.0
            continue
        nx, ny, nz = normal_of(i, outputs.road_terms)
        s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
        ahead, left, up = body_to_yawed(attitude, -s, c, 0.0)
        rise = max(-1.0, min(1.0, nx * ahead + ny * left + nz * up))
        level = square_root((1.0 - rise) * (1.0 + rise))
        s, c = vehicle.camber_sine[i], vehicle.camber_cosine[i]
        outputs.inclination[i] = math.atan2(rise, level) + vehicle.camber[i]
        outputs.inclination_sine[i] = rise * c + level * s
        outputs.inclination_cosine[i] = level * c - rise * s


@kernel
def force_on_road(i, outputs):
    """The whole force of the road on wheel i in frame 2 (N)."""
    terms = outputs.road_terms
    fx, fy = outputs.longitudinal_force[i], outputs.lateral_force[i]
    x, y, z = from_plane(i, fx, fy, outputs.normal_force[i], terms)
    return x + terms.side_x[i], y + terms.side_y[i], z


@kernel
def contact_moments_on_road(attitude, vehicle, outputs):
    """Moments at the contact points in frame 1 (N m), as `contact_moments` in the plane z = 0.

    Also those of the forces on the side of the wheels, and those of all forces about the point from
    which the equations of motion count them, on the body's z axis.
    """
    terms = outputs.road_terms
    for i in range(WHEEL_COUNT):
        shift = vehicle.tire_lateral_compliance[i] * outputs.tire_lateral[i]
        outputs.overturning_moment[i] += shift * outputs.normal_force[i]
        outputs.aligning_moment[i] -= shift * outputs.tire_longitudinal[i]
        mx, my = outputs.overturning_moment[i], outputs.rolling_resistance_moment[i]
        mz, s, c = outputs.aligning_moment[i], outputs.steering_sine[i], outputs.steering_cosine[i]
        x, y, z = from_plane(i, mx * c - my * s, my * c + mx * s, mz, terms)
        arm = terms.side_height[i]
        x, y = x - arm * terms.side_y[i], y + arm * terms.side_x[i]
        x, y, z = yawed_to_body(attitude, x, y, z)
        force = force_on_road(i, outputs)
        terms.force_x[i], terms.force_y[i], terms.force_z[i] = force
        fx, fy, fz = yawed_to_body(attitude, force[0], force[1], force[2])
        ax, ay, az = terms.arm_x[i], terms.arm_y[i], terms.arm_z[i] + outputs.loaded_radius[i]
        outputs.contact_moment_x[i] = x + ay * fz - az * fy
        outputs.contact_moment_y[i] = y + az * fx - ax * fz
        outputs.contact_moment_z[i] = z + ax * fy - ay * fx
        inclined, upright = outputs.inclination_sine[i], outputs.inclination_cosine[i]
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
