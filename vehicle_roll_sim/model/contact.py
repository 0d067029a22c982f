"""A wheel on the road: normal load, loaded radius, slip, and contact-patch forces."""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.compliance import (
    MOST_ITERATIONS,
    begin_to_yield,
    has_yielded,
    note_compliance_steer,
)
from vehicle_roll_sim.model.frames import yawed_to_body
from vehicle_roll_sim.model.records import LR, WHEEL_COUNT
from vehicle_roll_sim.model.tire.loads import terms_of_loads
from vehicle_roll_sim.model.tire.magic_formula import forces_at_slips
from vehicle_roll_sim.model.tire.radii import rolling_radii
from vehicle_roll_sim.model.tire.spring import spring_force
from vehicle_roll_sim.model.tire.transient_slip import transient_slip
from vehicle_roll_sim.model.tire.upright import upright_contact

SLOWEST_ROLLING = 1e-9
"""m/s: lower limit of the speed in the denominator of slip; keeps slip finite at zero speed."""


@kernel
def normal_force(support):
    """Fzg: normal load of one wheel (N), never negative, 0 off the ground (eq. 16)."""
    return support if support > 0.0 else 0.0


@kernel
def loaded_radius(tire_compression, radius, attitude):
    """Loaded radius r of a tire with vertical compression xt (m; eqs 15, 16).

    As in the paper, the radius along the body's z axis is reduced by the vertical compression
    divided by the cosines of pitch and roll.
    """
    _, c_roll, _, c_pitch = attitude
    return radius - tire_compression / (c_pitch * c_roll) if tire_compression > 0.0 else radius


@kernel
def wheel_motion(state, tires, outputs):
    """Velocity of every contact point along and across its wheel, and of the tread (m/s)."""
    spin = state[at.WHEEL_SPEED]
    for i in range(WHEEL_COUNT):
        ug, vg = outputs.contact_u[i], outputs.contact_v[i]
        s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
        outputs.rolling[i], outputs.sliding[i] = ug * c + vg * s, vg * c - ug * s
        outputs.tread[i] = outputs.rolling_radius[i] * spin[i]
        outputs.side[i] = (tires.front if i < LR else tires.rear).side[i]


@kernel
def steady_state_slip(outputs):
    """Slip ratio and tangent of the slip angle of every wheel (eqs 5, 6)."""
    for i in range(WHEEL_COUNT):
        rolling, sliding = outputs.rolling[i], outputs.sliding[i]
        speed = max(abs(rolling), SLOWEST_ROLLING)
        outputs.slip_ratio[i] = (outputs.tread[i] - rolling) / speed
        outputs.slip_tangent[i] = sliding / speed


@kernel
def contact_velocity(uu, vu, wu, wx, wy, r, attitude):
    """ug and vg: velocity of the contact point in frame 2 (m/s; eqs 7, 8)."""
    s_roll, c_roll, s_pitch, c_pitch = attitude
    rise = wu * c_roll + s_roll * (wx * r + vu)
    return c_pitch * (uu - wy * r) + s_pitch * rise, c_roll * (vu + wx * r) - wu * s_roll


@kernel
def small_angle_contact_velocity(i, wx, wy, vehicle, options, outputs):
    """ug and vg for small angles (m/s; eqs 41, 42), or those of the corner (eqs 65, 66).

    Admissible simplification of section 6.4: `fixed_strut_length` replaces ls + r by h.
    """
    reach = outputs.strut_length[i] + outputs.loaded_radius[i]
    if options.fixed_strut_length:
        reach = vehicle.cg_height
    if options.contact_moves_with_corner:
        reach = 0.0
    return outputs.corner_u[i] - wy * reach, outputs.corner_v[i] + wx * reach


@kernel
def contact_kinematics(state, vehicle, options, attitude, outputs):
    """Normal load (N), loaded radius (m) and contact velocity in frame 2 (m/s; eqs 7, 8, 13-16)."""
    wx, wy = state[at.ROLL_RATE], state[at.PITCH_RATE]
    xt, wu = state[at.TIRE_COMPRESSION], state[at.UNSPRUNG_VELOCITY]
    for i in range(WHEEL_COUNT):
        stiffness, progression = vehicle.tire_stiffness[i], vehicle.tire_progression[i]
        outputs.support[i] = spring_force(xt[i], stiffness, progression)  # (13)
        outputs.normal_force[i] = normal_force(outputs.support[i])
        if options.tire_normal_to_ground:
            upright_contact(i, state, vehicle, attitude, outputs)
            continue
        uu, vu = outputs.unsprung_u[i], outputs.unsprung_v[i]
        r = loaded_radius(xt[i], vehicle.tire_radius[i], attitude)
        outputs.loaded_radius[i] = r
        if options.small_angles:
            ug, vg = small_angle_contact_velocity(i, wx, wy, vehicle, options, outputs)
        else:
            ug, vg = contact_velocity(uu, vu, wu[i], wx, wy, r, attitude)
        outputs.contact_u[i], outputs.contact_v[i] = ug, vg


@kernel
def contact_forces(state, vehicle, tires, options, outputs):
    """Transient or steady-state slip, and contact forces in frame 2 (N; eqs 3-6).

    With compliance, slip and forces are computed until the wheels have yielded to them.
    """
    terms_of_loads(tires, outputs)
    rolling_radii(state[at.WHEEL_SPEED], tires, outputs)
    yields = vehicle.details.compliance != 0.0
    if yields:
        begin_to_yield(outputs)
    for iteration in range(MOST_ITERATIONS):
        wheel_motion(state, tires, outputs)
        if options.steady_state_slip:
            steady_state_slip(outputs)
        else:
            transient_slip(state, vehicle, tires, outputs)
        forces_at_slips(tires, outputs)
        if not yields or has_yielded(iteration, vehicle, tires, outputs):
            break
    if yields:
        note_compliance_steer(outputs)
    for i in range(WHEEL_COUNT):
        fx, fy = outputs.tire_longitudinal[i], outputs.tire_lateral[i]
        s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
        outputs.longitudinal_force[i] = fx * c - fy * s  # (3)
        outputs.lateral_force[i] = fy * c + fx * s  # (4)


@kernel
def contact_forces_on_body_axes(options, attitude, outputs):
    """Fxgs and Fygs, the contact forces of every wheel in frame 1 (N; eqs 2, 38, 59).

    Also the lateral force that acts on the roll motion with the loaded radius as lever arm (Fygs,
    or F'ygs of eq. 74).
    """
    s_roll, _, s_pitch, c_pitch = attitude
    for i in range(WHEEL_COUNT):
        fx, fy = outputs.longitudinal_force[i], outputs.lateral_force[i]
        fz = outputs.normal_force[i]
        if options.contact_forces_not_rotated:
            x, y = fx, fy
        elif options.small_angles:
            x, y = fx - s_pitch * fz, fy + s_roll * fz
        else:
            x, y, _ = yawed_to_body(attitude, fx, fy, fz)
        outputs.contact_x[i], outputs.contact_y[i] = x, y
        outputs.rolling_force[i] = y
        if options.tire_normal_to_ground:
            s_tilt, c_tilt = math.sin(outputs.tire_tilt[i]), math.cos(outputs.tire_tilt[i])
            outputs.rolling_force[i] = c_tilt * fy + s_tilt * (fz * c_pitch + fx * s_pitch)
