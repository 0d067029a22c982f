"""Access from Python to terms of the equations that compiled code only has inside its loops."""

import functools

from vehicle_roll_sim.model.compiled import jit


@functools.cache  # each one is compiled when it is called
def entry(term):
    """A function that Python can call and that gives what compiled code gets from `term`."""
    if not jit.COMPILED:
        return term
    return jit.numba.njit(lambda *arguments: term(*arguments), error_model="numpy")
