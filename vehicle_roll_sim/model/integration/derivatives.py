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
def smooth_derivatives(state, commands, plant, outputs, rates):
    """`derivatives` at any state, for calls from Python.

    Unlike `derivatives` it also notes which way each wheel turns and, in model 2, writes the tire
    compressions to `state`. commands: an array of one COMMAND record. plant: vehicle, tires and
    options, each an array of one record, and the ground, at time 0. It takes 20 us to pass a record
    to compiled code, and far less to pass an array.
    """
    vehicle, tires, options = plant[0][0], plant[1][0], plant[2][0]
    note_turning(state, outputs)
    derivatives(state, commands[0], vehicle, tires, options, plant[3], 0.0, outputs, rates)
    note_tire_compression(state, options, outputs)
