"""Integration with actuators in front of the vehicle; without any it is `advance` itself."""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.actuators import BEGIN, INSTANTS, QUEUE, act, note_demand
from vehicle_roll_sim.model.compiled.addresses import caller_of
from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.integration.advance import advance
from vehicle_roll_sim.model.integration.events import Condition

advance_at = caller_of(advance)


@kernel
def advance_actuated(address, arguments, actuation):
    """Integrate as `advance` does, with the commands as input of the actuators.

    address, arguments: of `advance`, and what it takes. actuation: ACTUATORS, in an array of one
    record, and the memory of the actuators as COMMAND records and as numbers, shape (rows,
    COMMAND_SIZE). Returns what `advance` returns. Steps are made one by one, so that it does not
    matter how many are asked for at once.
    """
    actuators, acting, memory = actuation[0][0], actuation[1], actuation[2]
    if actuators.present == 0.0:
        return advance_at(address, arguments)
    state, commands, steps, start_ns, step_ns, plant, outputs, events, stages = arguments
    stride = 0 if len(commands) == 1 else 1
    taken = 0
    while True:
        now, moves = start_ns + taken * step_ns, taken < steps
        step, first, speed = now // step_ns, 2 * taken * stride, state[at.U]
        queued = QUEUE + INSTANTS * (step % int(actuators.slots))
        for instant in range(INSTANTS):
            asked = commands[first + instant * stride if moves else first]
            note_demand(asked, speed, actuators, memory[queued + instant])
        act(step, moves, actuators, memory)
        one = (state, acting[BEGIN:INSTANTS], int(moves), now, step_ns, plant, outputs, events)
        moved, condition, culprit = advance_at(address, (*one, stages))
        taken += moved
        if moved == 0 or taken == steps or condition != Condition.RUNNING:
            return taken, condition, culprit
