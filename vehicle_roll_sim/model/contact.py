"""A wheel on the road: load, radius, slip and the forces of the contact patch."""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.frames import yawed_to_body
from vehicle_roll_sim.model.jit import kernel, math
from vehicle_roll_sim.model.records import LR, WHEEL_COUNT
from vehicle_roll_sim.model.tire import tire_forces

SLOWEST_ROLLING = 1e-9
"""Floor of the speed that slip is divided by (m/s): keeps a wheel that stands across finite."""


@kernel
def normal_force(tire_compression, tire_stiffness):
    """Fzg of one wheel (N): never negative, 0 off the ground (eqs 13, 16)."""
    return tire_stiffness * tire_compression if tire_compression > 0.0 else 0.0


@kernel
def loaded_radius(tire_compression, radius, c_roll, c_pitch):
    """Radius r of a tire compressed by xt towards the ground, as the source has it (m; eqs 15, 16).

    The source shortens the radius along the body's z axis by the compression along the vertical.
    """
    return radius - tire_compression / (c_pitch * c_roll) if tire_compression > 0.0 else radius


@kernel
def slip(ug, vg, steering, spin, radius):
    """Slip ratio and slip angle (rad) in wheel axes (eqs 5, 6)."""
    s, c = math.sin(steering), math.cos(steering)
    rolling, sliding = ug * c + vg * s, vg * c - ug * s
    speed = max(abs(rolling), SLOWEST_ROLLING)
    return (radius * spin - rolling) / speed, math.atan2(sliding, speed)


@kernel
def contact_kinematics(state, vehicle, attitude, outputs):
    """Load, loaded radius and contact velocity in frame 2 of every wheel (eqs 7, 8, 13-16)."""
    s_roll, c_roll, s_pitch, c_pitch = attitude
    wx, wy = state[at.ROLL_RATE], state[at.PITCH_RATE]
    xt, wu = state[at.TIRE_COMPRESSION], state[at.UNSPRUNG_VELOCITY]
    for i in range(WHEEL_COUNT):
        uu, vu = outputs.unsprung_u[i], outputs.unsprung_v[i]
        r = loaded_radius(xt[i], vehicle.tire_radius, c_roll, c_pitch)
        outputs.normal_force[i] = normal_force(xt[i], vehicle.tire_stiffness[i])
        outputs.loaded_radius[i] = r
        rise = wu[i] * c_roll + s_roll * (wx * r + vu)
        outputs.contact_u[i] = c_pitch * (uu - wy * r) + s_pitch * rise
        outputs.contact_v[i] = c_roll * (vu + wx * r) - wu[i] * s_roll


@kernel
def contact_forces(state, command, vehicle, tire, outputs):
    """Slip and contact forces of every wheel in frame 2 (eqs 3-6)."""
    spin = state[at.WHEEL_SPEED]
    for i in range(WHEEL_COUNT):
        steering = command.steering if i < LR else command.rear_steering
        ug, vg, r = outputs.contact_u[i], outputs.contact_v[i], outputs.loaded_radius[i]
        kappa, alpha = slip(ug, vg, steering, spin[i], r)
        fx, fy = tire_forces(kappa, alpha, outputs.normal_force[i], tire.side[i], tire)
        s, c = math.sin(steering), math.cos(steering)
        outputs.steering[i] = steering
        outputs.slip_ratio[i], outputs.slip_angle[i] = kappa, alpha
        outputs.tire_longitudinal[i], outputs.tire_lateral[i] = fx, fy
        outputs.longitudinal_force[i] = fx * c - fy * s  # (3)
        outputs.lateral_force[i] = fy * c + fx * s  # (4)


@kernel
def contact_forces_on_body_axes(attitude, outputs):
    """Fxgs and Fygs of every wheel: the contact forces in frame 1 (eq. 2)."""
    for i in range(WHEEL_COUNT):
        fx, fy, fz = (
            outputs.longitudinal_force[i],
            outputs.lateral_force[i],
            outputs.normal_force[i],
        )
        x, y, _ = yawed_to_body(attitude, fx, fy, fz)
        outputs.contact_x[i], outputs.contact_y[i] = x, y
