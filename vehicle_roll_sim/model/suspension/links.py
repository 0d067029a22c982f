"""Suspension links: horizontal forces between body and wheels, and the roll centres.

The longitudinal and lateral link forces (eqs 21, 22) contain the accelerations of the unsprung
mass, which depend on those of the body (eqs 54, 55, the first with the y term that the paper
omits). Each link force is therefore split into an `applied` part minus inertia times body
acceleration, and the accelerations are solved for in one linear system (`rigid_body`).
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, term
from vehicle_roll_sim.model.records import DU, DV, DWX, DWY, DWZ, LF, LR, RF, RR, WHEEL_COUNT


@kernel
def carried_mass(i, vehicle, options):
    """Unsprung mass whose inertia acts on the links of corner i (kg): 0 in eqs 56, 57."""
    return 0.0 if options.no_link_inertia else vehicle.unsprung_mass[i]


@kernel
def carried_weight(i, vehicle, options):
    """Unsprung weight in the link forces of corner i (N): 0 in eq. 59."""
    if options.contact_forces_not_rotated:
        return 0.0
    return vehicle.unsprung_mass[i] * vehicle.gravity


@kernel
def applied_link_forces(state, vehicle, options, attitude, outputs):
    """Link forces of every corner without the body's acceleration (N; eqs 21, 22, 54-57, 59)."""
    s_roll, _, s_pitch, c_pitch = attitude
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    wu = state[at.UNSPRUNG_VELOCITY]
    for i in range(WHEEL_COUNT):
        mu, weight = carried_mass(i, vehicle, options), carried_weight(i, vehicle, options)
        ls_rate = -outputs.suspension_rate[i]
        uu, vu = outputs.unsprung_u[i], outputs.unsprung_v[i]
        x_inertia = mu * (-ls_rate * wy - wz * vu + wy * wu[i])
        y_inertia = mu * (ls_rate * wx - wx * wu[i] + wz * uu)
        outputs.applied_x[i] = outputs.contact_x[i] + weight * s_pitch - x_inertia
        outputs.applied_y[i] = outputs.contact_y[i] - weight * s_roll * c_pitch - y_inertia
        outputs.applied_x[i] += vehicle.unsprung_mass[i] * outputs.slope_gravity[0]
        outputs.applied_y[i] += vehicle.unsprung_mass[i] * outputs.slope_gravity[1]


@kernel
def link_forces(vehicle, options, outputs):
    """Fxs and Fys of every corner (N), from the body's accelerations (eqs 21, 22)."""
    q = outputs.body_acceleration
    du, dv, dwx, dwy, dwz = q[DU], q[DV], q[DWX], q[DWY], q[DWZ]
    for i in range(WHEEL_COUNT):
        mu, ls = carried_mass(i, vehicle, options), outputs.strut_length[i]
        outputs.link_x[i] = outputs.applied_x[i] - mu * (du - vehicle.y[i] * dwz - ls * dwy)
        outputs.link_y[i] = outputs.applied_y[i] - mu * (dv + vehicle.x[i] * dwz + ls * dwx)


@kernel
def wheel_roll_moment(i, options, outputs):
    """Roll moment of the road on wheel i about its centre (N m): Fygs r, and the contact moment."""
    moment = outputs.rolling_force[i] * outputs.loaded_radius[i]
    if options.contact_moments:
        moment += outputs.contact_moment_x[i]
    return moment


@kernel
def link_moment(i, vehicle, options, outputs):
    """Roll moment of the contact and link forces of corner i about the roll centre (N m)."""
    arm = outputs.strut_length[i] - vehicle.roll_centre_depth[i]
    return wheel_roll_moment(i, options, outputs) + outputs.link_y[i] * arm


@kernel
def half_track(i, vehicle):
    """Distance of wheel i to the left of the centreline (m)."""
    other = i + 1 if i % 2 == 0 else i - 1
    return (vehicle.y[i] - vehicle.y[other]) / 2


@term
def middle(i, vehicle):
    """Distance of the centreline, at the axle of wheel i, to the left of the c.g. (m)."""
    other = i + 1 if i % 2 == 0 else i - 1
    return (vehicle.y[i] + vehicle.y[other]) / 2


@kernel
def link_load_transfer(vehicle, options, outputs):
    """Fdz of every corner (N): load transfer through the links (eq. 26).

    Symmetric for an axle, or each side separately (section 7.3); 0 without a roll centre.
    """
    for left, right in ((LF, RF), (LR, RR)):
        on_left, on_right = (
            link_moment(left, vehicle, options, outputs),
            link_moment(right, vehicle, options, outputs),
        )
        if options.no_roll_centre:
            on_left = on_right = 0.0
        elif not options.asymmetric_link_load_transfer:
            on_left = on_right = (on_left + on_right) / 2
        outputs.link_load_transfer[left] = -on_left / half_track(left, vehicle)
        outputs.link_load_transfer[right] = -on_right / half_track(right, vehicle)
