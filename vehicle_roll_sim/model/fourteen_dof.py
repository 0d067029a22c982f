"""The 14-degree-of-freedom vehicle of Shim and Ghike (2007): model 1, equations 1-37.

The simplified models share these stages; the options select other forms of some terms.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.air import move_through_air
from vehicle_roll_sim.model.body_contact import add_body_contact
from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.contact import (
    contact_forces,
    contact_forces_on_body_axes,
    contact_kinematics,
)
from vehicle_roll_sim.model.contact_moments import contact_moments
from vehicle_roll_sim.model.fallen_wheels import contact_of_fallen_wheels, release_wound_tires
from vehicle_roll_sim.model.frames import (
    attitude_of,
    body_to_yawed,
    euler_rates,
    heading_of,
    small_angle_euler_rates,
    yawed_to_ground,
)
from vehicle_roll_sim.model.gyroscopic import gyroscopic_moments
from vehicle_roll_sim.model.inclination import inclinations
from vehicle_roll_sim.model.records import DU, DV, DW, DWX, DWY, DWZ, WHEEL_COUNT
from vehicle_roll_sim.model.rigid_body import applied_forces, mass_matrix, solve_in_place
from vehicle_roll_sim.model.road.contact import (
    contact_moments_on_road,
    contact_on_road,
    inclinations_on_road,
    normal_friction,
    turn_forces_to_level,
)
from vehicle_roll_sim.model.road.slope import (
    slope_gravity_on_body_axes,
    tilted_gravity_on_body_axes,
)
from vehicle_roll_sim.model.steering import steer, steer_each_wheel
from vehicle_roll_sim.model.suspension.links import (
    applied_link_forces,
    link_forces,
    link_load_transfer,
)
from vehicle_roll_sim.model.suspension.strut_details import detailed_strut_forces
from vehicle_roll_sim.model.suspension.struts import strut_forces, strut_kinematics, unsprung_rates
from vehicle_roll_sim.model.wheel import wheel_rates


@kernel
def fourteen_dof_derivatives(state, command, vehicle, tires, options, ground, time, outputs, rates):
    """Rates of all states, and all intermediate quantities; see `derivatives`.

    ground: None for a plane. Older versions of numba prune branches by arguments that are None
    alone.
    """
    roll, pitch = state[at.ROLL], state[at.PITCH]
    heading, exact = heading_of(state[at.YAW]), attitude_of(roll, pitch)
    attitude = (roll, 1.0, pitch, 1.0) if options.small_angles else exact
    steer(command, outputs)
    if vehicle.details.steering != 0.0:
        steer_each_wheel(state, vehicle, options, outputs)

    slope_gravity_on_body_axes(heading, attitude, vehicle, outputs)
    normal_friction(outputs)
    move_through_air(state, command, heading, attitude, outputs)
    strut_kinematics(state, vehicle, options, outputs)
    if ground is None:
        contact_kinematics(state, vehicle, options, attitude, outputs)
        if options.body_contact:
            contact_of_fallen_wheels(state, vehicle, attitude, outputs)
        inclinations(attitude, vehicle, tires, options, outputs)
    else:
        tilted_gravity_on_body_axes(time, ground, heading, attitude, vehicle, outputs)
        contact_on_road(state, command, heading, vehicle, options, attitude, ground, outputs)
        inclinations_on_road(attitude, vehicle, tires, outputs)
    contact_forces(state, vehicle, tires, options, outputs)
    if options.body_contact:
        release_wound_tires(tires, outputs)
    if ground is not None:
        contact_moments_on_road(attitude, vehicle, outputs)
    elif options.contact_moments:
        contact_moments(attitude, vehicle, outputs)
    wheel_rates(state, command, vehicle, options, outputs, rates)
    if options.wheel_gyroscopics:
        gyroscopic_moments(state, vehicle, outputs, rates)
    if ground is not None:
        turn_forces_to_level(outputs)
    contact_forces_on_body_axes(options, attitude, outputs)
    if vehicle.details.struts != 0.0:
        detailed_strut_forces(state, command, vehicle, outputs)
    else:
        strut_forces(state, command, vehicle, outputs)
    applied_link_forces(state, vehicle, options, attitude, outputs)

    mass_matrix(vehicle, options, outputs)
    applied_forces(state, vehicle, options, attitude, outputs)
    if options.body_contact:
        add_body_contact(state, heading, attitude, vehicle, ground, outputs)
    solve_in_place(outputs.mass_matrix, outputs.body_acceleration)
    link_forces(vehicle, options, outputs)
    link_load_transfer(vehicle, options, outputs)

    body_rates(state, options, heading, attitude, outputs, rates)
    unsprung_rates(state, vehicle, options, attitude, outputs, rates)
    compression_rates(state, options, attitude, outputs, rates)
    accelerations(state, vehicle, exact, outputs)


@kernel
def attitude_rates(state, options, attitude):
    """Roll, pitch and yaw rates (rad/s; eqs 35-37, 51-53, 62-64)."""
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    if options.rates_not_rotated:
        return wx, wy, wz
    if options.small_angles:
        return small_angle_euler_rates(state[at.ROLL], state[at.PITCH], wx, wy, wz)
    return euler_rates(attitude, wx, wy, wz)


@kernel
def body_rates(state, options, heading, attitude, outputs, rates):
    """Rates of position, attitude and velocity of the sprung mass."""
    forward, left, rates[at.Z] = body_to_yawed(attitude, state[at.U], state[at.V], state[at.W])
    rates[at.X], rates[at.Y] = yawed_to_ground(heading, forward, left)
    turning = attitude_rates(state, options, attitude)
    rates[at.ROLL], rates[at.PITCH], rates[at.YAW] = turning
    q = outputs.body_acceleration
    rates[at.U], rates[at.V], rates[at.W] = q[DU], q[DV], q[DW]
    rates[at.ROLL_RATE], rates[at.PITCH_RATE], rates[at.YAW_RATE] = q[DWX], q[DWY], q[DWZ]


@kernel
def compression_rates(state, options, attitude, outputs, rates):
    """Rates of the suspension springs (eq. 12), and of the tires against z = 0 (eqs 14, 61)."""
    wu = state[at.UNSPRUNG_VELOCITY]
    for i in range(WHEEL_COUNT):
        uu, vu = outputs.unsprung_u[i], outputs.unsprung_v[i]
        _, _, rise = body_to_yawed(attitude, uu, vu, wu[i])
        rates[at.SUSPENSION_COMPRESSION][i] = outputs.suspension_rate[i]
        rates[at.TIRE_COMPRESSION][i] = -wu[i] if options.rates_not_rotated else -rise


@kernel
def accelerations(state, vehicle, attitude, outputs):
    """Acceleration of the sprung c.g. in frame 2, and its specific force in frame 1.

    They are measured quantities: in every model their axes are those of the exact attitude.
    """
    s_roll, c_roll, s_pitch, c_pitch = attitude
    q, u, v, w = outputs.body_acceleration, state[at.U], state[at.V], state[at.W]
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    ax, ay, az = q[DU] + wy * w - wz * v, q[DV] + wz * u - wx * w, q[DW] + wx * v - wy * u
    yawed = body_to_yawed(attitude, ax, ay, az)
    gravity = vehicle.gravity
    specific = (
        ax - gravity * s_pitch,
        ay + gravity * s_roll * c_pitch,
        az + gravity * c_roll * c_pitch,
    )
    for axis in range(len(yawed)):
        outputs.acceleration[axis] = yawed[axis]
        outputs.specific_force[axis] = specific[axis] - outputs.slope_gravity[axis]
