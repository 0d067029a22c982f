"""Struts: length and rate, forces of spring, damper and actuator, and the unsprung masses."""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.suspension.strut_details import apart_from_rest


@kernel
def strut_kinematics(state, vehicle, options, outputs):
    """Strut length and rate, and the velocity of each unsprung mass (eqs 1, 9, 10, 12, 17).

    Admissible simplifications of section 6.4: `fixed_strut_length` replaces ls in equations 9 and
    10 by the static length; `unsprung_moves_with_corner` replaces both by the corner's velocity.
    """
    u, v, w = state[at.U], state[at.V], state[at.W]
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    xs, wu = state[at.SUSPENSION_COMPRESSION], state[at.UNSPRUNG_VELOCITY]
    for i in range(WHEEL_COUNT):
        x, y = vehicle.x[i], vehicle.y[i]
        us, vs, ws = u - y * wz, v + x * wz, w + y * wx - x * wy  # (1)
        extension = vehicle.static_suspension_compression[i] - xs[i]
        ls = vehicle.static_strut_length[i] + extension  # (17)
        outputs.strut_length[i] = ls
        outputs.suspension_rate[i] = wu[i] - ws  # (12)
        reach = vehicle.static_strut_length[i] if options.fixed_strut_length else ls
        if options.unsprung_moves_with_corner:
            reach = 0.0
        outputs.corner_u[i], outputs.corner_v[i] = us, vs
        outputs.unsprung_u[i] = us - reach * wy  # (9)
        outputs.unsprung_v[i] = vs + reach * wx  # (10)


@kernel
def strut_forces(state, command, vehicle, outputs):
    """Fzs of every corner (N): spring, damper, anti-roll bar and active normal force (eq. 23)."""
    xs = state[at.SUSPENSION_COMPRESSION]
    for i in range(WHEEL_COUNT):
        passive = vehicle.spring_stiffness[i] * xs[i]
        passive += vehicle.damping[i] * outputs.suspension_rate[i]
        passive += vehicle.bar_rate[i] * apart_from_rest(i, state, vehicle)
        outputs.strut_force[i] = passive + command.normal_force[i]


@kernel
def unsprung_rates(state, vehicle, options, attitude, outputs, rates):
    """Vertical acceleration of every unsprung mass in frame 1 (m/s^2; eqs 11, 43, 58, 60)."""
    s_roll, c_roll, s_pitch, c_pitch = attitude
    wx, wy = state[at.ROLL_RATE], state[at.PITCH_RATE]
    for i in range(WHEEL_COUNT):
        mu = vehicle.unsprung_mass[i]
        load = outputs.normal_force[i] - mu * vehicle.gravity
        upward = c_pitch * load + s_pitch * outputs.longitudinal_force[i]
        force = c_roll * upward - s_roll * outputs.lateral_force[i]
        if options.unsprung_forces_not_rotated:
            force = load  # (60)
        force -= outputs.link_load_transfer[i] + outputs.strut_force[i]
        force += mu * outputs.slope_gravity[2]
        turning = outputs.unsprung_v[i] * wx - outputs.unsprung_u[i] * wy
        if options.no_unsprung_turning:
            turning = 0.0  # (58)
        rates[at.UNSPRUNG_VELOCITY][i] = force / mu - turning
