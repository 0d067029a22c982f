"""The 8-degree-of-freedom vehicle of section 8: equations 77-87.

The body rolls about an axis fixed in the vehicle; it neither heaves nor pitches, and the wheels
have no vertical motion. u and v are those of the point of the roll axis below the c.g. States that
this model does not have are nan.

Normal loads depend on the accelerations, these on the tire forces, and these on the normal loads:
they are iterated, starting from zero acceleration, until they agree.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.air import drag
from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.contact import contact_forces, normal_force
from vehicle_roll_sim.model.frames import attitude_of, heading_of, yawed_to_ground
from vehicle_roll_sim.model.inclination import inclinations
from vehicle_roll_sim.model.records import DU, DV, DWX, DWZ, LF, LR, WHEEL_COUNT
from vehicle_roll_sim.model.road.contact import normal_friction
from vehicle_roll_sim.model.road.slope import slope_gravity_on_yawed_axes
from vehicle_roll_sim.model.roll_axis import (
    corner_damping,
    corner_stiffness,
    over_wheels,
    roll_axis_depth,
    strut_share,
    wheel_centre_height,
)
from vehicle_roll_sim.model.steering import steer, steer_each_wheel
from vehicle_roll_sim.model.tire.spring import compression_under
from vehicle_roll_sim.model.wheel import wheel_rates

MOST_ITERATIONS = 200
AGREEMENT = 1e-12
"""Convergence tolerance of the accelerations, relative to their magnitude plus 1 m/s^2."""


@kernel
def eight_dof_derivatives(state, command, vehicle, tires, options, outputs, rates):
    """Rates of the states of this model, and all intermediate quantities; see `derivatives`."""
    heading = heading_of(state[at.YAW])
    steer(command, outputs)
    if vehicle.details.steering != 0.0:
        steer_each_wheel(state, vehicle, options, outputs)
    contact_velocities(state, vehicle, outputs)
    normal_friction(outputs)
    inclinations(attitude_of(state[at.ROLL], 0.0), vehicle, tires, options, outputs)
    slope_gravity_on_yawed_axes(heading, vehicle, outputs)
    accelerate(state, command, vehicle, tires, options, outputs)
    rates[at.X], rates[at.Y] = yawed_to_ground(heading, state[at.U], state[at.V])
    rates[at.YAW], rates[at.ROLL] = state[at.YAW_RATE], state[at.ROLL_RATE]
    q = outputs.body_acceleration
    rates[at.U], rates[at.V] = q[DU], q[DV]
    rates[at.YAW_RATE], rates[at.ROLL_RATE] = q[DWZ], q[DWX]
    wheel_rates(state, command, vehicle, options, outputs, rates)
    measured_accelerations(state, vehicle, outputs)


@kernel
def contact_velocities(state, vehicle, outputs):
    """ug and vg of every wheel (m/s; eqs 82, 83)."""
    u, v, wz = state[at.U], state[at.V], state[at.YAW_RATE]
    for i in range(WHEEL_COUNT):
        outputs.contact_u[i] = u - vehicle.y[i] * wz
        outputs.contact_v[i] = v + vehicle.x[i] * wz


@kernel
def accelerate(state, command, vehicle, tires, options, outputs):
    """Solve for consistent normal loads, tire forces and accelerations (eqs 77-87).

    Broyden's method in ax and ay; its first step is a fixed-point iteration. On a grade or bank, ax
    and ay exclude the component of gravity along the road. The accelerations are nan if the method
    does not converge.
    """
    q, wz, slope = outputs.body_acceleration, state[at.YAW_RATE], outputs.slope_gravity
    q[:] = math.nan
    ax, ay, x_step, y_step = 0.0, 0.0, 0.0, 0.0
    slopes = (-1.0, 0.0, 0.0, -1.0)
    for _ in range(MOST_ITERATIONS):
        tire_loads(state, command, ax, ay, vehicle, options, outputs)
        contact_forces(state, vehicle, tires, options, outputs)
        x_gap = longitudinal_acceleration(state, vehicle, outputs) - ax
        y_gap = lateral_acceleration(state, command, vehicle, options, outputs) - ay
        if abs(x_gap) + abs(y_gap) <= AGREEMENT * (1.0 + abs(ax) + abs(ay)):
            q[DU] = ax + slope[0] + wz * state[at.V]
            q[DV] = ay + slope[1] - wz * state[at.U]
            q[DWZ] = yaw_acceleration(ay, vehicle, outputs)
            q[DWX] = roll_acceleration(state, command, ay, vehicle, options)
            break
        slopes = corrected(slopes, x_step, y_step, x_gap, y_gap)
        x_step, y_step = solution(slopes, -x_gap, -y_gap)
        ax, ay = ax + x_step, ay + y_step


@kernel
def corrected(slopes, x_step, y_step, x_gap, y_gap):
    """Broyden's update of the Jacobian of the residuals with respect to ax and ay."""
    length = x_step**2 + y_step**2
    if length == 0.0:
        return slopes
    xx, xy, yx, yy = slopes
    x_gap, y_gap = x_gap / length, y_gap / length
    return xx + x_gap * x_step, xy + x_gap * y_step, yx + y_gap * x_step, yy + y_gap * y_step


@kernel
def solution(matrix, x, y):
    """Solution of two linear equations; the matrix is given row by row."""
    xx, xy, yx, yy = matrix
    determinant = xx * yy - xy * yx
    return (yy * x - xy * y) / determinant, (xx * y - yx * x) / determinant


@kernel
def tire_loads(state, command, ax, ay, vehicle, options, outputs):
    """Normal load (N) and loaded radius (m) of every wheel at ax and ay (m/s^2; eqs 84-87)."""
    pitching = vehicle.sprung_mass * vehicle.cg_height
    for i in range(WHEEL_COUNT):
        pitching += vehicle.unsprung_mass[i] * wheel_centre_height(i, vehicle)
    pitching *= ax / (2 * (vehicle.x[LF] - vehicle.x[LR]))  # lx
    for i in range(WHEEL_COUNT):
        y, stiffness = vehicle.y[i], vehicle.tire_stiffness[i]
        progression = vehicle.tire_progression[i]
        carried = vehicle.sprung_mass * vehicle.axle_load_share[i]
        overturning = carried * (vehicle.cg_height - vehicle.roll_centre_depth[i])
        overturning += vehicle.unsprung_mass[i] * wheel_centre_height(i, vehicle)
        load = (carried + vehicle.unsprung_mass[i]) * vehicle.gravity  # sf, sr
        load -= overturning * ay / y
        load += active_load(i, command, vehicle, options)
        load -= strut_reaction(i, state, vehicle, options)
        load += -pitching if i < LR else pitching
        outputs.support[i] = load
        outputs.normal_force[i] = normal_force(load)
        compression = compression_under(outputs.normal_force[i], stiffness, progression)
        outputs.loaded_radius[i] = vehicle.tire_radius[i] - compression


@kernel
def strut_reaction(i, state, vehicle, options):
    """(kphi phi + bphi dphi/dt) / c: reduction of the load at corner i by body roll (N)."""
    force = corner_stiffness(i, vehicle, options) * state[at.ROLL]
    force += corner_damping(i, vehicle, options) * state[at.ROLL_RATE]
    return force * vehicle.y[i]


@kernel
def active_load(i, command, vehicle, options):
    """Contribution of the active forces of an axle to the normal load of wheel i (N).

    Not in the paper. The struts transmit their share of the roll moment, which acts on the road as
    a pair of forces. The sum of the forces would lift the body, which this model cannot represent.
    """
    other = i + 1 if i % 2 == 0 else i - 1
    own = strut_share(i, vehicle, options) * command.normal_force[i]
    return (own - strut_share(other, vehicle, options) * command.normal_force[other]) / 2


@kernel
def unsprung_imbalance(vehicle):
    """Muf a - Mur b: first moment of the unsprung masses about the c.g. (kg m)."""
    return over_wheels(vehicle.unsprung_mass, vehicle.x)


@kernel
def total_mass(vehicle):
    """mt: mass of the whole vehicle (kg)."""
    mass = vehicle.sprung_mass
    for i in range(WHEEL_COUNT):
        mass += vehicle.unsprung_mass[i]
    return mass


@kernel
def longitudinal_acceleration(state, vehicle, outputs):
    """ax = du/dt - wz v (m/s^2; eq. 77)."""
    wx, wz = state[at.ROLL_RATE], state[at.YAW_RATE]
    force = unsprung_imbalance(vehicle) * wz**2
    force -= 2 * roll_axis_depth(vehicle) * vehicle.sprung_mass * wz * wx
    force -= drag(state[at.U], vehicle)
    for i in range(WHEEL_COUNT):
        force += outputs.longitudinal_force[i]
    return force / total_mass(vehicle)


@kernel
def lateral_acceleration(state, command, vehicle, options, outputs):
    """ay = dv/dt + wz u (m/s^2; eq. 78, with the yaw and roll accelerations of 79 and 80)."""
    imbalance, arm = unsprung_imbalance(vehicle), coupling(vehicle)
    yawing, rolling = yaw_inertia(vehicle), roll_inertia(vehicle)
    force = -imbalance * yaw_acceleration(0.0, vehicle, outputs)
    force += arm * roll_acceleration(state, command, 0.0, vehicle, options)
    for i in range(WHEEL_COUNT):
        force += outputs.lateral_force[i]
    return force / (total_mass(vehicle) - imbalance**2 / yawing - arm**2 / rolling)


@kernel
def coupling(vehicle):
    """hrc m: coupling of roll and lateral motion (kg m)."""
    return roll_axis_depth(vehicle) * vehicle.sprung_mass


@kernel
def yaw_inertia(vehicle):
    """Yaw moment of inertia of the whole vehicle (kg m^2; defined below eq. 79)."""
    inertia = vehicle.yaw_inertia
    for i in range(WHEEL_COUNT):
        inertia += vehicle.unsprung_mass[i] * (vehicle.x[i] ** 2 + vehicle.y[i] ** 2)
    return inertia


@kernel
def roll_inertia(vehicle):
    """Moment of inertia of the sprung mass about the roll axis (kg m^2; eq. 80)."""
    return vehicle.roll_inertia + coupling(vehicle) * roll_axis_depth(vehicle)


@kernel
def yaw_acceleration(ay, vehicle, outputs):
    """Yaw acceleration (rad/s^2) from the tire forces and the lateral acceleration ay (eq. 79)."""
    moment = over_wheels(vehicle.x, outputs.lateral_force)
    moment -= over_wheels(vehicle.y, outputs.longitudinal_force)
    return (moment - unsprung_imbalance(vehicle) * ay) / yaw_inertia(vehicle)


@kernel
def roll_acceleration(state, command, ay, vehicle, options):
    """Roll acceleration (rad/s^2) from weight, struts, active forces and ay (m/s^2; eq. 80)."""
    moment = coupling(vehicle) * (vehicle.gravity * state[at.ROLL] + ay)
    for i in range(WHEEL_COUNT):
        strut = active_load(i, command, vehicle, options)
        strut -= strut_reaction(i, state, vehicle, options)
        moment += vehicle.y[i] * strut
    return moment / roll_inertia(vehicle)


@kernel
def measured_accelerations(state, vehicle, outputs):
    """Acceleration of the sprung c.g. in frame 2 and its specific force in frame 1.

    The c.g. is hrc above the roll axis and moves sideways in roll: terms as in equations 77 and 78.
    Its height is constant, consistent with weight and struts in equation 80.
    """
    q, depth = outputs.body_acceleration, roll_axis_depth(vehicle)
    wx, wz, roll = state[at.ROLL_RATE], state[at.YAW_RATE], state[at.ROLL]
    ax = q[DU] - wz * state[at.V] + 2 * depth * wz * wx
    ay = q[DV] + wz * state[at.U] - depth * q[DWX]
    outputs.acceleration[0], outputs.acceleration[1] = ax, ay
    outputs.acceleration[2] = math.nan
    s, c, g = math.sin(roll), math.cos(roll), vehicle.gravity
    felt = ay - outputs.slope_gravity[1]
    outputs.specific_force[0] = ax - outputs.slope_gravity[0]
    outputs.specific_force[1] = c * felt + s * g
    outputs.specific_force[2] = c * g - s * felt
