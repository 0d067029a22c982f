"""Time derivative of the state, for any of the models."""

from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.eight_dof import eight_dof_derivatives
from vehicle_roll_sim.model.fourteen_dof import fourteen_dof_derivatives
from vehicle_roll_sim.model.kinematic.contact import note_tire_compression
from vehicle_roll_sim.model.kinematic.derivatives import kinematic_derivatives
from vehicle_roll_sim.model.road.layout import USED
from vehicle_roll_sim.model.wheel import note_turning


@kernel
def derivatives(state, command, vehicle, tires, options, ground, time, outputs, rates):
    """Write the time derivative of `state` to `rates`, and intermediate quantities to `outputs`.

    state, rates: flat vectors laid out as records.STATE. ground: see `road.layout`. time:
    simulated time (s), on which a ground that tilts depends. The other arguments are records
    (tires: of TIRES). Rates and outputs that the model does not have are left unchanged: nan from
    the start of a run.
    """
    if options.eight_dof:
        eight_dof_derivatives(state, command, vehicle, tires, options, outputs, rates)
    elif options.kinematic:
        if ground[USED] == 0.0:
            kinematic_derivatives(
                state, command, vehicle, tires, options, None, time, outputs, rates
            )
        else:
            kinematic_derivatives(
                state, command, vehicle, tires, options, ground, time, outputs, rates
            )
    elif ground[USED] == 0.0:
        fourteen_dof_derivatives(
            state, command, vehicle, tires, options, None, time, outputs, rates
        )
    else:
        fourteen_dof_derivatives(
            state, command, vehicle, tires, options, ground, time, outputs, rates
        )


@kernel
def derivatives_at(state, commands, plant, outputs, rates, is_smooth):
    """`derivatives` for calls from Python, at time 0.

    is_smooth: also note which way each wheel turns and, in model 2, write the tire compressions to
    `state`, so that any state may be given. commands, outputs: arrays of one record each. plant:
    vehicle, tires and options, each an array of one record, and the ground. It takes 20 us to pass
    a record to compiled code, and far less to pass an array.
    """
    vehicle, tires, options, seen = plant[0][0], plant[1][0], plant[2][0], outputs[0]
    if is_smooth:
        note_turning(state, seen)
    derivatives(state, commands[0], vehicle, tires, options, plant[3], 0.0, seen, rates)
    if is_smooth:
        note_tire_compression(state, options, seen)
