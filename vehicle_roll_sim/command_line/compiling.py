"""Compile the model before a command runs it, or say why it will be slow."""

import sys

from vehicle_roll_sim.command_line.signals import PROGRAM
from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.simulation import compilation


def compile_model() -> None:
    """Compile the model if necessary; if numba is not installed, say so once on stderr.

    Nothing is said if the user has disabled compilation with NUMBA_DISABLE_JIT.
    """
    if jit.numba is None:
        print(f"{PROGRAM}: {jit.why_slow()}", file=sys.stderr, flush=True)
    compilation.compile_model()
