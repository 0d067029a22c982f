"""One period of many simulations in one call of compiled code."""

from vehicle_roll_sim.model.integration.actuated import advance_actuated
from vehicle_roll_sim.model.integration.drive import unlocked

NOW, CONDITION = range(2)
"""Columns of the progress of the simulations: simulated time (ns) and condition."""
PROGRESS_SIZE = 2


@unlocked
def step_each(address, memory, plants, actuation, commands, steps, step_ns, progress, first, last):
    """Advance the simulations from `first` to before `last`, each with its command held.

    address: of `advance`. memory: state vectors, shape (n, STATE_SIZE), outputs, events and work
    space; plants: vehicles, tires, options, limits and zero commands, in arrays of n records, as
    are the commands, and the grounds of all in one array, with their beginnings and ends in it,
    shape (n, 2). actuation: actuators, and their memory as records, shape (n, rows), and as
    numbers. steps: number of steps of each; one with 0 is left alone. step_ns: integration step
    (ns). progress: see above; changed in place.
    """
    states, outputs, events, stages = memory
    vehicles, tires, options, limits, idle, grounds, bounds = plants
    actuators, acting, numbers = actuation
    for i in range(first, last):
        if steps[i] == 0:
            continue
        one = slice(i, i + 1)
        ground = grounds[bounds[i, 0] : bounds[i, 1]]
        plant = (vehicles[one], tires[one], options[one], limits[one], idle[one], ground)
        of_this = (plant, outputs[one], events[one], stages[i])
        now = progress[i, NOW]
        arguments = (states[i], commands[one], steps[i], now, step_ns, *of_this)
        actuated = (actuators[one], acting[i], numbers[i])
        taken, condition, _ = advance_actuated(address, arguments, actuated)
        progress[i, NOW] = now + taken * step_ns
        progress[i, CONDITION] = condition
