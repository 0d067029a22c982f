"""Acceleration of body and wheels: one symmetric linear system in six unknowns.

The unknowns are the specific force f = dv/dt + w x v - g of the body's c.g. and the derivative of
its angular velocity, both in frame 1. The travels are eliminated beforehand: a wheel resists along
its path with its own inertia only, and across it moves with the body.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.air import add_side_force_and_lift, drag
from vehicle_roll_sim.model.compiled.jit import kernel, term
from vehicle_roll_sim.model.frames import yawed_to_body
from vehicle_roll_sim.model.records import (
    DEGREES_OF_ACCELERATION,
    DU,
    DV,
    DW,
    DWX,
    DWY,
    DWZ,
    LF,
    LR,
    RF,
    RR,
    WHEEL_COUNT,
)
from vehicle_roll_sim.model.wheel import drive_torque


@kernel
def forces_on_body_axes(attitude, outputs):
    """Contact force of every wheel in frame 1 (N)."""
    for i in range(WHEEL_COUNT):
        fx, fy = outputs.longitudinal_force[i], outputs.lateral_force[i]
        x, y, z = yawed_to_body(attitude, fx, fy, outputs.normal_force[i])
        outputs.contact_x[i], outputs.contact_y[i], outputs.contact_z[i] = x, y, z


@kernel
def travel_forces(state, command, vehicle, options, outputs):
    """Generalized force on the travel of every wheel (N), without the wheel's weight.

    The contact force acts along dP/dq, tire moments and the reaction of the drive torque, which
    comes from the body, turn with the carrier. The brake acts between wheel and carrier.
    """
    terms, spin = outputs.suspension_terms, state[at.WHEEL_SPEED]
    hold = command.speed_hold_gain * (command.speed_hold_target - state[at.U])
    for i in range(WHEEL_COUNT):
        kx, ky = terms.carrier_turn[0, i], terms.carrier_turn[1, i]
        kz = terms.carrier_turn[2, i]
        force = outputs.contact_x[i] * terms.contact_path[0, i]
        force += outputs.contact_y[i] * terms.contact_path[1, i]
        force += outputs.contact_z[i] * terms.contact_path[2, i]
        along = kx * terms.spin_axis[0, i] + ky * terms.spin_axis[1, i]
        along += kz * terms.spin_axis[2, i]
        torque = drive_torque(i, hold, spin, command, vehicle)
        force += along * torque - outputs.strut_force[i]
        if options.contact_moments:
            force += kx * outputs.contact_moment_x[i] + ky * outputs.contact_moment_y[i]
            force += kz * outputs.contact_moment_z[i]
        terms.travel_force[i] = force


@kernel
def parts_of_wheels(state, vehicle, outputs):
    """What every wheel adds to mass matrix and right-hand side, in the order of `system`."""
    terms = outputs.suspension_terms
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    part = terms.of_wheels
    for i in range(WHEEL_COUNT):
        terms.resisting_mass[i] = vehicle.unsprung_mass[i]
    for i in range(WHEEL_COUNT):
        mu, rate = terms.resisting_mass[i], outputs.suspension_rate[i]
        x, y, z = terms.wheel[0, i], terms.wheel[1, i], terms.wheel[2, i]
        tx, ty = terms.path[0, i], terms.path[1, i]
        rx, ry, rz = y - z * ty, z * tx - x, x * ty - y * tx  # moment of the path's direction
        inverse = 1.0 / (tx * tx + ty * ty + 1.0)
        share = mu * inverse
        sx, sy, sz = share * rx, share * ry, share * rz
        part[0, i] = mu - share * tx * tx
        part[1, i] = -share * tx * ty
        part[2, i] = mu - share * ty * ty
        part[3, i] = -share * tx
        part[4, i] = -share * ty
        part[5, i] = mu - share
        part[6, i] = -sx * tx
        part[7, i] = -mu * z - sx * ty
        part[8, i] = mu * y - sx
        part[9, i] = mu * (y * y + z * z) - sx * rx
        part[10, i] = mu * z - sy * tx
        part[11, i] = -sy * ty
        part[12, i] = -mu * x - sy
        part[13, i] = -mu * x * y - sy * rx
        part[14, i] = mu * (x * x + z * z) - sy * ry
        part[15, i] = -mu * y - sz * tx
        part[16, i] = mu * x - sz * ty
        part[17, i] = -sz
        part[18, i] = -mu * x * z - sz * rx
        part[19, i] = -mu * y * z - sz * ry
        part[20, i] = mu * (x * x + y * y) - sz * rz
        spin_x, spin_y, spin_z = wy * z - wz * y, wz * x - wx * z, wx * y - wy * x
        square = rate * rate
        bx = wy * spin_z - wz * spin_y + 2 * rate * (wy - wz * ty)
        bx += terms.path_bend[0, i] * square
        by = wz * spin_x - wx * spin_z + 2 * rate * (wz * tx - wx)
        by += terms.path_bend[1, i] * square
        bz = wx * spin_y - wy * spin_x + 2 * rate * (wx * ty - wy * tx)
        pull = (mu * (tx * bx + ty * by + bz) - terms.travel_force[i]) * inverse
        terms.pull[i] = pull
        fx, fy, fz = outputs.contact_x[i], outputs.contact_y[i], outputs.contact_z[i]
        px, py, pz = fx - mu * bx + pull * tx, fy - mu * by + pull * ty, fz - mu * bz + pull
        ax, ay, az = terms.arm[0, i], terms.arm[1, i], terms.arm[2, i]
        part[21, i], part[22, i], part[23, i] = px, py, pz
        part[24, i] = y * pz - z * py + ay * fz - az * fy
        part[25, i] = z * px - x * pz + az * fx - ax * fz
        part[26, i] = x * py - y * px + ax * fy - ay * fx


@kernel
def system(state, vehicle, options, outputs):
    """Mass matrix (lower triangle) and right-hand side, with the travels eliminated."""
    terms = outputs.suspension_terms
    parts_of_wheels(state, vehicle, outputs)
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    a, f, part = outputs.mass_matrix, outputs.body_acceleration, terms.of_wheels
    k = 0
    for row in range(DEGREES_OF_ACCELERATION):
        for column in range(row + 1):
            a[row, column] = (part[k, LF] + part[k, RF]) + (part[k, LR] + part[k, RR])
            k += 1
    for row in range(DEGREES_OF_ACCELERATION):
        f[row] = (part[k, LF] + part[k, RF]) + (part[k, LR] + part[k, RR])
        k += 1
    jx, jy, jz = vehicle.roll_inertia, vehicle.pitch_inertia, vehicle.yaw_inertia
    m = vehicle.sprung_mass
    a[DU, DU], a[DV, DV], a[DW, DW] = a[DU, DU] + m, a[DV, DV] + m, a[DW, DW] + m
    a[DWX, DWX], a[DWY, DWY] = a[DWX, DWX] + jx, a[DWY, DWY] + jy
    a[DWZ, DWZ] += jz
    f[DU] -= drag(outputs.air_velocity[0], vehicle)
    if vehicle.side_and_lift > 0.0:
        add_side_force_and_lift(vehicle, outputs)
    f[DWX] += (jy - jz) * wy * wz
    f[DWY] += (jz - jx) * wz * wx
    f[DWZ] += (jx - jy) * wx * wy
    jxy, jxz, jyz = vehicle.roll_pitch_product, vehicle.roll_yaw_product, vehicle.pitch_yaw_product
    a[DWY, DWX] -= jxy
    a[DWZ, DWX] -= jxz
    a[DWZ, DWY] -= jyz
    f[DWX] += jyz * (wy * wy - wz * wz) + wx * (jxz * wy - jxy * wz)
    f[DWY] += jxz * (wz * wz - wx * wx) + wy * (jxy * wz - jyz * wx)
    f[DWZ] += jxy * (wx * wx - wy * wy) + wz * (jyz * wx - jxz * wy)
    if options.contact_moments:
        for i in range(WHEEL_COUNT):
            f[DWX] += outputs.contact_moment_x[i]
            f[DWY] += outputs.contact_moment_y[i]
            f[DWZ] += outputs.contact_moment_z[i]


@kernel
def solve_symmetric(a, f):
    """Replace f by the solution of a q = f; of `a` the lower triangle is used, and overwritten.

    L D L^T without pivoting: the matrix is positive definite.
    """
    eliminate_below(a, f, DU)
    eliminate_below(a, f, DV)
    eliminate_below(a, f, DW)
    eliminate_below(a, f, DWX)
    eliminate_below(a, f, DWY)
    f[DWZ] /= a[DWZ, DWZ]
    complete_above(a, f, DWZ)
    complete_above(a, f, DWY)
    complete_above(a, f, DWX)
    complete_above(a, f, DW)
    complete_above(a, f, DV)


@term
def eliminate_below(a, f, unknown):
    """Eliminate an unknown from the equations below it, and divide its own by the pivot."""
    inverse = 1.0 / a[unknown, unknown]
    for row in range(unknown + 1, DEGREES_OF_ACCELERATION):
        factor = a[row, unknown] * inverse
        for column in range(unknown + 1, row + 1):
            a[row, column] -= factor * a[column, unknown]
        f[row] -= factor * f[unknown]
    f[unknown] *= inverse
    for row in range(unknown + 1, DEGREES_OF_ACCELERATION):
        a[row, unknown] *= inverse


@term
def complete_above(a, f, unknown):
    """Back substitution: subtract an unknown from the equations above."""
    for row in range(unknown):
        f[row] -= a[unknown, row] * f[unknown]


@kernel
def wheel_accelerations(state, vehicle, outputs, rates):
    """Rates of wu (m/s^2), still without those of w."""
    terms = outputs.suspension_terms
    f = outputs.body_acceleration
    wx, wy = state[at.ROLL_RATE], state[at.PITCH_RATE]
    for i in range(WHEEL_COUNT):
        x, y, z = terms.wheel[0, i], terms.wheel[1, i], terms.wheel[2, i]
        tx, ty = terms.path[0, i], terms.path[1, i]
        rx, ry, rz = y - z * ty, z * tx - x, x * ty - y * tx
        carried = tx * f[DU] + ty * f[DV] + f[DW] + rx * f[DWX] + ry * f[DWY] + rz * f[DWZ]
        share = 1.0 / (tx * tx + ty * ty + 1.0)
        acceleration = -terms.pull[i] / vehicle.unsprung_mass[i] - carried * share
        rate = outputs.suspension_rate[i]
        turning = f[DWX] * y - f[DWY] * x + (wx * ty - wy * tx) * rate
        rates[at.UNSPRUNG_VELOCITY][i] = acceleration + turning


@kernel
def body_derivatives(state, vehicle, attitude, outputs, rates):
    """From the specific force to the derivatives of u, v and w, and the rates of wu (m/s^2)."""
    s_roll, c_roll, s_pitch, c_pitch = attitude
    q, g = outputs.body_acceleration, vehicle.gravity
    u, v, w = state[at.U], state[at.V], state[at.W]
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    q[DU] += g * s_pitch + outputs.slope_gravity[0] - (wy * w - wz * v)
    q[DV] += outputs.slope_gravity[1] - g * s_roll * c_pitch - (wz * u - wx * w)
    q[DW] += outputs.slope_gravity[2] - g * c_roll * c_pitch - (wx * v - wy * u)
    for i in range(WHEEL_COUNT):
        rates[at.UNSPRUNG_VELOCITY][i] += q[DW]
