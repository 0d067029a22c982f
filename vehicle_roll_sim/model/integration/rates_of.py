"""The rates of many states in one call of compiled code."""

from vehicle_roll_sim.model.compiled.addresses import caller_of
from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.integration.advance import advance
from vehicle_roll_sim.model.integration.integrator import K1, copy

advance_at = caller_of(advance)


@kernel
def rates_of(address, states, commands, plant, outputs, events, stages, rates, culprits):
    """Write the rates of each state vector to a row of `rates`, one after the other.

    address: of `advance`. states, rates: shape (n, STATE_SIZE). culprits: shape (n,), the index of
    the rate that is not finite, else -1. Other arguments: those of `advance`.
    """
    for k in range(len(states)):
        taken = (states[k], commands, 0, 0, 1, plant, outputs, events, stages)
        _, _, culprit = advance_at(address, taken)
        copy(stages[K1], rates[k])
        culprits[k] = culprit
