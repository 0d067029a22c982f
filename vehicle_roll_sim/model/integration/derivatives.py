"""Time derivative of the state, for any of the models."""

from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.eight_dof import eight_dof_derivatives
from vehicle_roll_sim.model.fourteen_dof import fourteen_dof_derivatives
from vehicle_roll_sim.model.kinematic.derivatives import kinematic_derivatives


@kernel
def derivatives(state, command, vehicle, tires, options, outputs, rates):
    """Write the time derivative of `state` to `rates`, and intermediate quantities to `outputs`.

    state, rates: flat vectors laid out as records.STATE. The other arguments are records (tires: of
    TIRES). Rates and outputs that the model does not have are left
    unchanged: nan from the start of a run.
    """
    if options.eight_dof:
        eight_dof_derivatives(state, command, vehicle, tires, options, outputs, rates)
    elif options.kinematic:
        kinematic_derivatives(state, command, vehicle, tires, options, outputs, rates)
    else:
        fourteen_dof_derivatives(state, command, vehicle, tires, options, outputs, rates)
