"""The six equations of the sprung mass as one linear system in its accelerations (eqs 29-34)."""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.air import add_side_force_and_lift, drag
from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.records import (
    DU,
    DV,
    DW,
    DWX,
    DWY,
    DWZ,
    WHEEL_COUNT,
)
from vehicle_roll_sim.model.suspension.links import (
    carried_mass,
    half_track,
    middle,
    wheel_roll_moment,
)


@kernel
def mass_matrix(vehicle, options, outputs):
    """Left-hand side: inertia of the body and of the unsprung masses coupled by the links.

    The products of inertia are not in the paper.

    Symmetric and positive definite without a roll centre. With a roll centre, the lever arm in the
    roll equation is the depth of the roll centre instead of the strut length.
    """
    a = outputs.mass_matrix
    a[:, :] = 0.0
    a[DU, DU] = a[DV, DV] = moved_mass(vehicle, options)
    a[DW, DW] = vehicle.sprung_mass
    a[DWX, DWX], a[DWY, DWY] = vehicle.roll_inertia, vehicle.pitch_inertia
    a[DWZ, DWZ] = vehicle.yaw_inertia
    a[DWX, DWY] = a[DWY, DWX] = 0.0 - vehicle.roll_pitch_product
    a[DWX, DWZ] = a[DWZ, DWX] = 0.0 - vehicle.roll_yaw_product
    a[DWY, DWZ] = a[DWZ, DWY] = 0.0 - vehicle.pitch_yaw_product
    for i in range(WHEEL_COUNT):
        mu, ls = carried_mass(i, vehicle, options), outputs.strut_length[i]
        x, y = vehicle.x[i], vehicle.y[i]
        lever = ls if options.no_roll_centre else vehicle.roll_centre_depth[i]
        a[DU, DU] += mu  # longitudinal link forces, (21) and (54)
        a[DU, DWY] -= mu * ls
        a[DU, DWZ] -= mu * y
        a[DV, DV] += mu  # lateral link forces, (22) and (55)
        a[DV, DWX] += mu * ls
        a[DV, DWZ] += mu * x
        a[DWX, DV] += lever * mu  # their moments, (24) or (25)
        a[DWX, DWX] += lever * mu * ls
        a[DWX, DWZ] += lever * mu * x
        a[DWY, DU] -= ls * mu  # (27)
        a[DWY, DWY] += ls * mu * ls
        a[DWY, DWZ] += ls * mu * y
        a[DWZ, DU] -= y * mu  # (34)
        a[DWZ, DV] += x * mu
        a[DWZ, DWX] += x * mu * ls
        a[DWZ, DWY] += y * mu * ls
        a[DWZ, DWZ] += mu * (x * x + y * y)
        if options.asymmetric_link_load_transfer:
            # share of Fdz per lateral acceleration
            share = mu * (ls - vehicle.roll_centre_depth[i]) / half_track(i, vehicle)
            beside = share * middle(i, vehicle)
            a[DW, DV] -= share  # (31) with the sum of Fdz
            a[DW, DWX] -= share * ls
            a[DW, DWZ] -= share * x
            a[DWX, DV] -= beside  # (32) with its moment, if the roll centre is beside the c.g.
            a[DWX, DWX] -= beside * ls
            a[DWX, DWZ] -= beside * x
            a[DWY, DV] += x * share  # (33) with their moment
            a[DWY, DWX] += x * share * ls
            a[DWY, DWZ] += x * share * x


@kernel
def moved_mass(vehicle, options):
    """Mass in the longitudinal and lateral equations (kg).

    Lumping the unsprung masses into it is the error described in section 5.
    """
    mass = vehicle.sprung_mass
    if options.lumped_unsprung_mass:
        for i in range(WHEEL_COUNT):
            mass += vehicle.unsprung_mass[i]
    return mass


@kernel
def applied_forces(state, vehicle, options, attitude, outputs):
    """Right-hand side: weight, gyroscopic terms and the forces and moments of the corners."""
    s_roll, c_roll, s_pitch, c_pitch = attitude
    f = outputs.body_acceleration
    u, v, w = state[at.U], state[at.V], state[at.W]
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    m, moved = vehicle.sprung_mass, moved_mass(vehicle, options)
    weight = m * vehicle.gravity
    f[DU] = weight * s_pitch - moved * (wy * w - wz * v)  # (29)
    f[DV] = -weight * s_roll * c_pitch - moved * (wz * u - wx * w)  # (30)
    f[DW] = -weight * c_roll * c_pitch - m * (wx * v - wy * u)  # (31)
    f[DU] += m * outputs.slope_gravity[0] - drag(outputs.air_velocity[0], vehicle)
    f[DV] += m * outputs.slope_gravity[1]
    f[DW] += m * outputs.slope_gravity[2]
    f[DWX] = f[DWY] = f[DWZ] = 0.0
    if vehicle.side_and_lift > 0.0:
        add_side_force_and_lift(vehicle, outputs)
    if options.euler_terms:
        jx, jy, jz = vehicle.roll_inertia, vehicle.pitch_inertia, vehicle.yaw_inertia
        f[DWX] += (jy - jz) * wy * wz
        f[DWY] += (jz - jx) * wz * wx
        f[DWZ] += (jx - jy) * wx * wy
        jxz = vehicle.roll_yaw_product
        f[DWX] += jxz * wx * wy
        f[DWY] += jxz * (wz * wz - wx * wx)
        f[DWZ] -= jxz * wy * wz
        jxy, jyz = vehicle.roll_pitch_product, vehicle.pitch_yaw_product
        f[DWX] += jyz * (wy * wy - wz * wz) - jxy * wz * wx
        f[DWY] += jxy * wy * wz - jyz * wx * wy
        f[DWZ] += jxy * (wx * wx - wy * wy) + jyz * wz * wx
    for i in range(WHEEL_COUNT):
        x, y, ls, r = vehicle.x[i], vehicle.y[i], outputs.strut_length[i], outputs.loaded_radius[i]
        fx, fy, fz = outputs.applied_x[i], outputs.applied_y[i], outputs.strut_force[i]
        f[DU] += fx
        f[DV] += fy
        f[DW] += fz
        f[DWX] += y * fz + roll_moment(i, vehicle, options, outputs)  # (32)
        f[DWZ] += x * fy - y * fx  # (34), (28)
        if options.tire_normal_to_ground:
            lean = state[at.ROLL] - outputs.tire_tilt[i]
            f[DWY] -= x * fz + outputs.contact_x[i] * r * math.cos(lean) + fx * ls  # (72)
            f[DWZ] += outputs.longitudinal_force[i] * r * math.sin(lean)  # (73)
        else:
            f[DWY] -= x * fz + outputs.contact_x[i] * r + fx * ls  # (33), (27)
        if options.contact_moments:
            f[DWY] += outputs.contact_moment_y[i]
            f[DWZ] += outputs.contact_moment_z[i]
        if options.asymmetric_link_load_transfer:
            moment = wheel_roll_moment(i, options, outputs)
            moment += fy * (ls - vehicle.roll_centre_depth[i])
            half = half_track(i, vehicle)
            f[DW] -= moment / half  # (31) with the sum of Fdz
            f[DWX] -= middle(i, vehicle) * moment / half  # (32), (33) with their moment
            f[DWY] += x * moment / half


@kernel
def roll_moment(i, vehicle, options, outputs):
    """Roll moment of the lateral link force of corner i, with or without roll centre (25, 24)."""
    if options.no_roll_centre:
        about_strut = wheel_roll_moment(i, options, outputs)
        return about_strut + outputs.applied_y[i] * outputs.strut_length[i]
    return outputs.applied_y[i] * vehicle.roll_centre_depth[i]


@kernel
def solve_in_place(a, f):
    """Replace f by the solution of a q = f by Gaussian elimination; `a` is overwritten.

    The sparsity is exploited: the longitudinal and lateral equations do not contain each other's
    acceleration, and the vertical acceleration occurs in its own equation only. Pivoting is
    unnecessary, since the matrix is a diagonally dominant inertia matrix.
    """
    eliminate(a, f, DU, (DWY, DWZ), (DWY, DWZ))
    eliminate(a, f, DV, (DWX, DWZ), (DWX, DWY, DWZ))
    eliminate(a, f, DWX, (DWY, DWZ), (DWY, DWZ))
    eliminate(a, f, DWY, (DWZ,), (DWZ,))
    f[DWZ] /= a[DWZ, DWZ]
    complete(a, f, DWY, (DWZ,))
    complete(a, f, DWX, (DWY, DWZ))
    complete(a, f, DV, (DWX, DWZ))
    complete(a, f, DU, (DWY, DWZ))
    complete(a, f, DW, (DV, DWX, DWZ))
    f[DW] /= a[DW, DW]


@term
def eliminate(a, f, unknown, others, rows):
    """Normalize the row of an unknown and eliminate the unknown from `rows`."""
    pivot = a[unknown, unknown]
    f[unknown] /= pivot
    for other in others:
        a[unknown, other] /= pivot
    for row in rows:
        f[row] -= a[row, unknown] * f[unknown]
        for other in others:
            a[row, other] -= a[row, unknown] * a[unknown, other]


@term
def complete(a, f, unknown, others):
    """Back substitution: subtract the other unknowns from the right-hand side."""
    for other in others:
        f[unknown] -= a[unknown, other] * f[other]
