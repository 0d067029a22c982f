"""The vehicle on a kinematic suspension: model 2, with 14 degrees of freedom.

A rigid body and four point masses, each on a path that its suspension prescribes, on tires that
touch the road wherever their inclination puts them. Exact mechanics: energy and momentum balance.
Stages that it shares with model 1 are those of `fourteen_dof`.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.air import move_through_air
from vehicle_roll_sim.model.body_contact import add_body_contact
from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.contact import contact_forces
from vehicle_roll_sim.model.contact_moments import contact_moments
from vehicle_roll_sim.model.fallen_wheels import release_lying_wheels, release_wound_tires
from vehicle_roll_sim.model.fourteen_dof import accelerations, body_rates
from vehicle_roll_sim.model.frames import attitude_of, heading_of
from vehicle_roll_sim.model.gyroscopic import gyroscopic_moments_on_carriers
from vehicle_roll_sim.model.kinematic.contact import (
    compression_rates,
    contact_motion,
    place_on_road,
)
from vehicle_roll_sim.model.kinematic.guidance import carriers, look_up, paths, wheel_velocities
from vehicle_roll_sim.model.kinematic.motion import (
    body_derivatives,
    forces_on_body_axes,
    solve_symmetric,
    system,
    travel_forces,
    wheel_accelerations,
)
from vehicle_roll_sim.model.kinematic.road_contact import (
    motion_in_plane,
    place_on_uneven_road,
)
from vehicle_roll_sim.model.kinematic.roll_centre import roll_centres
from vehicle_roll_sim.model.road.contact import (
    contact_moments_on_road,
    normal_friction,
    turn_forces_to_level,
)
from vehicle_roll_sim.model.road.slope import (
    slope_gravity_on_body_axes,
    tilted_gravity_on_body_axes,
)
from vehicle_roll_sim.model.steering import steer, steer_each_wheel
from vehicle_roll_sim.model.suspension.strut_details import detailed_strut_forces
from vehicle_roll_sim.model.suspension.struts import strut_forces
from vehicle_roll_sim.model.wheel import wheel_rates


@kernel
def kinematic_derivatives(state, command, vehicle, tires, options, ground, time, outputs, rates):
    """Rates of all states, and all intermediate quantities; see `derivatives`.

    ground: None for a plane. Older versions of numba prune branches by arguments that are None
    alone.
    """
    heading, attitude = heading_of(state[at.YAW]), attitude_of(state[at.ROLL], state[at.PITCH])
    steer(command, outputs)
    if vehicle.details.steering != 0.0:
        steer_each_wheel(state, vehicle, options, outputs)

    slope_gravity_on_body_axes(heading, attitude, vehicle, outputs)
    normal_friction(outputs)
    move_through_air(state, command, heading, attitude, outputs)
    look_up(state, vehicle, outputs)
    carriers(vehicle, outputs)
    paths(vehicle, outputs)
    wheel_velocities(state, outputs)
    if ground is None:
        place_on_road(state, vehicle, attitude, outputs)
        contact_motion(state, attitude, outputs)
    else:
        tilted_gravity_on_body_axes(time, ground, heading, attitude, vehicle, outputs)
        place_on_uneven_road(state, command, heading, vehicle, attitude, ground, outputs)
        contact_motion(state, attitude, outputs)
        motion_in_plane(state, heading, attitude, ground, outputs)
    if options.body_contact:
        release_lying_wheels(vehicle, ground, outputs)
    contact_forces(state, vehicle, tires, options, outputs)
    if options.body_contact:
        release_wound_tires(tires, outputs)
    if ground is not None:
        contact_moments_on_road(attitude, vehicle, outputs)
    elif options.contact_moments:
        contact_moments(attitude, vehicle, outputs)
    wheel_rates(state, command, vehicle, options, outputs, rates)
    if options.wheel_gyroscopics:
        gyroscopic_moments_on_carriers(state, vehicle, outputs, rates)
    if ground is not None:
        turn_forces_to_level(outputs)
    forces_on_body_axes(attitude, outputs)
    if vehicle.details.struts != 0.0:
        detailed_strut_forces(state, command, vehicle, outputs)
    else:
        strut_forces(state, command, vehicle, outputs)
    travel_forces(state, command, vehicle, options, outputs)

    system(state, vehicle, options, outputs)
    if options.body_contact:
        add_body_contact(state, heading, attitude, vehicle, ground, outputs)
    solve_symmetric(outputs.mass_matrix, outputs.body_acceleration)
    wheel_accelerations(state, vehicle, outputs, rates)
    body_derivatives(state, vehicle, attitude, outputs, rates)

    body_rates(state, options, heading, attitude, outputs, rates)
    compression_rates(state, vehicle, attitude, outputs, rates)
    accelerations(state, vehicle, attitude, outputs)
    roll_centres(state, attitude, outputs)
