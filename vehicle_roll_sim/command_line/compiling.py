"""The model compiled before a command runs it, or a line on why it is slow."""

import sys

from vehicle_roll_sim.command_line.ending import PROGRAM
from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.simulation import compilation


def compile_model() -> None:
    """Have the model compiled; where numba is not installed, say so once on stderr.

    NUMBA_DISABLE_JIT is its user's own wish and no news.
    """
    if jit.numba is None:
        print(f"{PROGRAM}: {jit.why_slow()}", file=sys.stderr, flush=True)
    compilation.compile_model()
