"""Time derivative of the state, whichever the model."""

from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.eight_dof import eight_dof_derivatives
from vehicle_roll_sim.model.fourteen_dof import fourteen_dof_derivatives


@kernel
def derivatives(state, command, vehicle, tire, options, outputs, rates):
    """Time derivative of the state, into `rates`, and all that leads to it, into `outputs`.

    `state` and `rates` are flat vectors laid out as records.STATE, the others records. States and
    outputs that the model does not have are left as they are: nan, from the start of a run.
    """
    if options.eight_dof:
        eight_dof_derivatives(state, command, vehicle, tire, options, outputs, rates)
    else:
        fourteen_dof_derivatives(state, command, vehicle, tire, options, outputs, rates)
